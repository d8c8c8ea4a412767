// Effects as a set of bits. Kernels are templates over the set they were compiled for; the host picks the
// smallest compiled set that covers what the scene needs, so an absent effect costs nothing.
#pragma once

#include <cstdint>

#include "core/kernel/base/platform.h"

namespace pl {

enum class Feature : std::uint32_t {
    SmoothNormals = 1u << 0,       ///< shading normals differ from geometric ones
    Environment = 1u << 1,         ///< rays that leave the scene see light
    NextEventEstimation = 1u << 2  ///< shadow rays towards lights, combined by multiple importance sampling
};

inline constexpr Feature kAllFeatures[] = {Feature::SmoothNormals, Feature::Environment,
                                           Feature::NextEventEstimation};

/// A set of features; usable as a template argument.
struct FeatureSet {
    std::uint32_t bits = 0;

    PL_HD constexpr bool has(Feature feature) const { return (bits & static_cast<std::uint32_t>(feature)) != 0; }
    PL_HD constexpr bool covers(FeatureSet needed) const { return (needed.bits & ~bits) == 0; }
    PL_HD constexpr FeatureSet with(Feature feature) const { return {bits | static_cast<std::uint32_t>(feature)}; }
    PL_HD friend constexpr bool operator==(FeatureSet, FeatureSet) = default;
};

/// The sets that are compiled, smallest first; the last one holds every feature.
inline constexpr FeatureSet kCompiledSets[] = {
    FeatureSet{},
    FeatureSet{}.with(Feature::NextEventEstimation),
    FeatureSet{}.with(Feature::SmoothNormals).with(Feature::Environment),
    FeatureSet{}.with(Feature::SmoothNormals).with(Feature::Environment).with(Feature::NextEventEstimation),
};
inline constexpr int kCompiledSetCount = static_cast<int>(sizeof(kCompiledSets) / sizeof(kCompiledSets[0]));

/// Index into kCompiledSets of the first (smallest) set that covers `needed`.
constexpr int smallest_superset(FeatureSet needed) {
    for (int i = 0; i < kCompiledSetCount; ++i)
        if (kCompiledSets[i].covers(needed)) return i;
    return kCompiledSetCount - 1;
}

static_assert(kCompiledSets[kCompiledSetCount - 1].has(Feature::SmoothNormals));
static_assert(smallest_superset(FeatureSet{}) == 0);

}  // namespace pl
