// Effects of light transport as a bit set. Kernels are templates over it; the host chooses the smallest compiled set
// that covers the effects the scene needs, so an absent effect costs nothing.
#pragma once

#include <cstdint>

#include "core/kernel/base/platform.h"

namespace pl {

enum class Feature : std::uint32_t {
    SmoothNormals = 1u << 0,        ///< shading normals differ from geometric ones
    Environment = 1u << 1,          ///< escaped rays receive a constant radiance
    NextEventEstimation = 1u << 2,  ///< light samples with shadow rays, combined by multiple importance sampling
    Specular = 1u << 3,             ///< delta lobes: mirrors and clear glass
    Rough = 1u << 4,                ///< microfacet lobes: rough metals and rough glass
    Plastic = 1u << 5,              ///< Lambert under a dielectric coat
    Textures = 1u << 6,             ///< images on surfaces, colors of vertices
    CutOuts = 1u << 7,              ///< surfaces with holes, and with partial opacity
    EnvironmentMap = 1u << 8,       ///< infinitely distant light that depends on the direction: an image, a sun
    ThinLens = 1u << 9,             ///< a camera with a finite aperture
    ManyLights = 1u << 10,          ///< light samples choose lights by a light tree instead of by power alone
    NormalMaps = 1u << 11,          ///< images of shading normals
    DeltaLights = 1u << 12,         ///< lights without extent: points, spots, directions
    Absorption = 1u << 13,          ///< glass that absorbs light along the way through it
    ThinPanes = 1u << 14,           ///< thin sheets of clear glass
    Blends = 1u << 15,              ///< surfaces of two materials, chosen at random by their shares
    Anisotropy = 1u << 16,          ///< facets of rough metals that are wider in one direction than in the other
    Instances = 1u << 17,           ///< meshes that are stored once and shown many times
    Velvet = 1u << 18,              ///< a sheen of fibers over a Lambert base
};

/// An effect and its stable name, for `info`, `--stats` and `--force-effects`. Converts to the effect.
struct FeatureInfo {
    Feature value;
    const char* name;

    constexpr operator Feature() const { return value; }
};
inline constexpr FeatureInfo kAllFeatures[] = {
    {Feature::SmoothNormals, "smooth-normals"},
    {Feature::Environment, "environment"},
    {Feature::NextEventEstimation, "next-event-estimation"},
    {Feature::Specular, "specular"},
    {Feature::Rough, "rough"},
    {Feature::Plastic, "plastic"},
    {Feature::Textures, "textures"},
    {Feature::CutOuts, "cut-outs"},
    {Feature::EnvironmentMap, "environment-map"},
    {Feature::ThinLens, "thin-lens"},
    {Feature::ManyLights, "many-lights"},
    {Feature::NormalMaps, "normal-maps"},
    {Feature::DeltaLights, "delta-lights"},
    {Feature::Absorption, "absorption"},
    {Feature::ThinPanes, "thin-panes"},
    {Feature::Blends, "blends"},
    {Feature::Anisotropy, "anisotropy"},
    {Feature::Instances, "instances"},
    {Feature::Velvet, "velvet"},
};

/// A set of features; usable as a template argument.
struct FeatureSet {
    std::uint32_t bits = 0;

    PL_HD constexpr bool has(Feature feature) const { return (bits & static_cast<std::uint32_t>(feature)) != 0; }
    PL_HD constexpr bool has_any(FeatureSet other) const { return (bits & other.bits) != 0; }
    PL_HD constexpr bool covers(FeatureSet needed) const { return (needed.bits & ~bits) == 0; }
    PL_HD constexpr FeatureSet with(Feature feature) const { return {bits | static_cast<std::uint32_t>(feature)}; }
    PL_HD constexpr FeatureSet without(Feature feature) const {
        return {bits & ~static_cast<std::uint32_t>(feature)};
    }
    PL_HD constexpr FeatureSet with(FeatureSet other) const { return {bits | other.bits}; }
    PL_HD constexpr FeatureSet common(FeatureSet other) const { return {bits & other.bits}; }
    PL_HD friend constexpr bool operator==(FeatureSet, FeatureSet) = default;
};

template <class... Features>
PL_HD constexpr FeatureSet features(Features... list) {
    return {(0u | ... | static_cast<std::uint32_t>(list))};
}

/// Effects of surfaces that have other lobes than Lambert's.
inline constexpr FeatureSet kLobeFeatures = features(Feature::Specular, Feature::Rough, Feature::Plastic);

/// Effects that decide the BSDF of a surface point; sets that differ in others alone share its functions.
inline constexpr FeatureSet kSurfaceFeatures =
    kLobeFeatures.with(features(Feature::ThinPanes, Feature::Anisotropy, Feature::Velvet));

/// Effects that decide the place of a surface point.
inline constexpr FeatureSet kPlaceFeatures = features(Feature::Instances);

/// Effects by which shading normals differ from geometric ones.
inline constexpr FeatureSet kNormalFeatures = features(Feature::SmoothNormals, Feature::NormalMaps);

inline constexpr FeatureSet kEveryFeature = [] {
    FeatureSet all;
    for (const Feature feature : kAllFeatures) all = all.with(feature);
    return all;
}();

/// Effects of Lambert reflectors under lights that need no image and no tree.
inline constexpr FeatureSet kPlainFeatures =
    features(Feature::SmoothNormals, Feature::Environment, Feature::NextEventEstimation);

/// The compiled sets, each before its supersets; the last one holds every feature. Chosen by what scenes need, one group after the
/// other: boxes, rooms of Lambert reflectors, such rooms with images or many lamps, metals and glass without images, files of other
/// programs, and instances and velvet, which few of these have: their code makes the other kernels slower.
inline constexpr FeatureSet kCompiledSets[] = {
    features(),
    features(Feature::NextEventEstimation),
    kPlainFeatures,
    kPlainFeatures.with(features(Feature::Textures, Feature::EnvironmentMap, Feature::ManyLights)),
    kPlainFeatures.with(kLobeFeatures),
    kEveryFeature.without(Feature::Instances).without(Feature::Velvet),
    kEveryFeature,
};
inline constexpr int kCompiledSetCount = static_cast<int>(sizeof(kCompiledSets) / sizeof(kCompiledSets[0]));

/// Density of the compiled sets of a kernel: build time against unused branches.
enum class KernelRange {
    Full,
    Sparse,  ///< kPlainFeatures and every feature: for kernels that few use, or that take little of the time
};
constexpr bool is_in_range(FeatureSet compiled, KernelRange range) {
    return range == KernelRange::Full || compiled == kPlainFeatures || compiled == kEveryFeature;
}

/// Index into kCompiledSets of the first set of a range that covers `needed`.
constexpr int smallest_superset(FeatureSet needed, KernelRange range = KernelRange::Full) {
    for (int i = 0; i < kCompiledSetCount; ++i)
        if (is_in_range(kCompiledSets[i], range) && kCompiledSets[i].covers(needed)) return i;
    return kCompiledSetCount - 1;
}

/// Whether kernels of a range are compiled for the set of this number.
constexpr bool is_compiled(int set, KernelRange range) {
    return set < kCompiledSetCount && smallest_superset(kCompiledSets[set], range) == set;
}

static_assert(kCompiledSets[kCompiledSetCount - 1] == kEveryFeature);
static_assert(smallest_superset(FeatureSet{}) == 0);

}  // namespace pl
