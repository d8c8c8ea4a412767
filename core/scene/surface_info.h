// Materials describe themselves: each number of a material, and each kind of surface, is one row. Packing, effects, readers and writers of
// files, checks, `info` and the window follow the rows.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "core/base/choice.h"
#include "core/kernel/base/features.h"
#include "core/scene/description.h"
#include "core/scene/directional_albedo.h"

namespace pl {

template <>
inline constexpr auto kChoices<NormalGreen> = std::to_array<ChoiceInfo<NormalGreen>>({
    {NormalGreen::Up, "up", "Up"},
    {NormalGreen::Down, "down", "Down"},
    {NormalGreen::Left, "left", "Left"},
});

template <>
inline constexpr auto kChoices<OpacityRule> = std::to_array<ChoiceInfo<OpacityRule>>({
    {OpacityRule::Threshold, "threshold", "Holes"},
    {OpacityRule::Blend, "blend", "Share"},
});

/// A number of a material, or a color, whose channels are checked one by one. Either `number` or `color` is its member.
struct MaterialParameter {
    const char* name;   ///< in files
    const char* words;  ///< in messages
    float MaterialDescription::*number = nullptr;
    glm::vec3 MaterialDescription::*color = nullptr;
    float least = 0.0f, most = 1.0f;  ///< valid values; finite ones alone
    float slider_least = least, slider_most = most;
    const char* format = "%.3f";  ///< of the slider, for printf
};

namespace material_parameter {

inline constexpr float kNoLimit = std::numeric_limits<float>::infinity();

inline constexpr MaterialParameter kAlbedo{
    .name = "albedo", .words = "albedo", .color = &MaterialDescription::albedo};
inline constexpr MaterialParameter kRoughness{
    .name = "roughness", .words = "roughness", .number = &MaterialDescription::roughness};
inline constexpr MaterialParameter kAnisotropy{
    .name = "anisotropy", .words = "anisotropy", .number = &MaterialDescription::anisotropy, .most = kMostAnisotropy};
inline constexpr MaterialParameter kRotation{.name = "rotation_deg",
                                             .words = "rotation",
                                             .number = &MaterialDescription::rotation_deg,
                                             .least = -kNoLimit,
                                             .most = kNoLimit,
                                             .slider_least = -180.0f,
                                             .slider_most = 180.0f,
                                             .format = "%.1f"};
inline constexpr MaterialParameter kIor{.name = "ior",
                                        .words = "index of refraction",
                                        .number = &MaterialDescription::ior,
                                        .least = kLeastIor,
                                        .most = kMostIor};
inline constexpr MaterialParameter kSpecular{
    .name = "specular", .words = "specular", .color = &MaterialDescription::specular};
inline constexpr MaterialParameter kEdgeTint{
    .name = "edge_tint", .words = "edge tint", .color = &MaterialDescription::edge_tint};
inline constexpr MaterialParameter kTransmission{
    .name = "transmission", .words = "transmission", .color = &MaterialDescription::transmission};
inline constexpr MaterialParameter kAbsorption{
    .name = "absorption", .words = "absorption", .color = &MaterialDescription::absorption, .most = kNoLimit};

}  // namespace material_parameter

inline constexpr const MaterialParameter* kMaterialParameters[] = {
    &material_parameter::kAlbedo,   &material_parameter::kRoughness,    &material_parameter::kAnisotropy,
    &material_parameter::kRotation, &material_parameter::kIor,          &material_parameter::kSpecular,
    &material_parameter::kEdgeTint, &material_parameter::kTransmission, &material_parameter::kAbsorption};

/// An image of a material.
struct MaterialImage {
    const char* name;  ///< in files: of the member, or of a member's member
    std::uint32_t TextureUse::*texture;
    TextureContent content;
};
inline constexpr MaterialImage kMaterialImages[] = {{"albedo_map", &TextureUse::albedo, TextureContent::Color},
                                                    {"roughness_map", &TextureUse::roughness, TextureContent::Number},
                                                    {"emission_map", &TextureUse::emission, TextureContent::Color},
                                                    {"opacity_map", &TextureUse::opacity, TextureContent::Opacity},
                                                    {"normal_map", &TextureUse::normal, TextureContent::Normal},
                                                    {"blend/image", &TextureUse::blend, TextureContent::Number}};

/// A parameter of a kind of surface, as the window shows it.
struct SurfaceParameter {
    const MaterialParameter* parameter;
    const char* label;
    const char* tip;
    bool (*matters)(const MaterialDescription&) = nullptr;  ///< whether it is shown; always without this
    /// Of a color without a limit: label and tip of the color, beside the row of its largest channel.
    const char* color_label = nullptr;
    const char* color_tip = nullptr;
};

/// All that is specific to a kind of surface outside of the kernels.
struct SurfaceInfo {
    ChoiceInfo<SurfaceKind> choice;
    FeatureSet effects{};  ///< needed besides Specular, of smooth surfaces, or Rough
    /// Color by which programs that know no more show the surface; images multiply the color, except the color of
    /// glass.
    glm::vec3 MaterialDescription::*color = &MaterialDescription::albedo;
    /// Surfaces at least this rough are guided, by the smaller of two widths.
    float least_guided_roughness = 0.0f;
    bool transmits = false;   ///< glass, solid or thin
    bool has_inside = false;  ///< which paths enter and leave
    /// Tables of directional albedo for an index of refraction, one behind the other, of rough surfaces; see AlbedoTable.
    std::vector<float> (*tables)(float ior) = nullptr;
    bool has_smooth_tables = false;  ///< smooth surfaces need them, too
    std::span<const SurfaceParameter> parameters{};
    /// Text of `info`, with parameters by their names and {finish}, {grain} and {absorbed}.
    const char* text;

    constexpr bool has(const MaterialParameter& parameter) const {
        return std::ranges::find(parameters, &parameter, &SurfaceParameter::parameter) != parameters.end();
    }
};

namespace surface_parameter {

inline constexpr SurfaceParameter kColor{&material_parameter::kAlbedo, "Color", "Diffuse reflectance."};
inline constexpr SurfaceParameter kReflected{&material_parameter::kSpecular, "Reflected",
                                             "Tint of the light that glass or coat reflects."};
inline constexpr SurfaceParameter kTransmitted{&material_parameter::kTransmission, "Transmitted",
                                               "Tint of the transmitted light."};
inline constexpr SurfaceParameter kRoughness{
    &material_parameter::kRoughness, "Roughness",
    "0 is a mirror; the alpha of the microfacet distribution is its square."};
inline constexpr SurfaceParameter kIndex{
    &material_parameter::kIor, "Index",
    "Index of refraction, inside over outside: water 1.33, glass 1.5, diamond 2.4."};

inline constexpr SurfaceParameter kOfDiffuse[] = {kColor};
inline constexpr SurfaceParameter kOfConductor[] = {
    {&material_parameter::kSpecular, "Reflectance", "Of the metal at normal incidence."},
    {&material_parameter::kEdgeTint, "Edge tint", "Reflectance at 82 degrees over that of Schlick's approximation."},
    kRoughness,
    {&material_parameter::kAnisotropy, "Anisotropy",
     "1 - the ratio of the smaller to the larger width of the facets; 0: the same both ways.",
     [](const MaterialDescription& m) { return m.roughness > 0.0f; }},
    {&material_parameter::kRotation, "Rotation", "Angle of the larger width from that of u of the images, towards v.",
     [](const MaterialDescription& m) { return m.is_anisotropic(); }},
};
inline constexpr SurfaceParameter kOfDielectric[] = {
    kReflected,
    kTransmitted,
    kRoughness,
    kIndex,
    {.parameter = &material_parameter::kAbsorption,
     .label = "Absorption",
     .tip = "Of the glass, per unit of length, in the largest channel: it lets the share exp(-absorption x length) "
            "through. 0: clear.",
     .color_label = "Absorbed",
     .color_tip = "Color of the light that the glass takes away."},
};
inline constexpr SurfaceParameter kOfPlastic[] = {kColor, kReflected, kRoughness, kIndex};
inline constexpr SurfaceParameter kOfVelvet[] = {
    kColor,
    {&material_parameter::kSpecular, "Sheen", "Reflectance of the fibers, which shines towards the horizon."},
    {&material_parameter::kRoughness, "Roughness",
     "Spread of the fibers. 1: the sheen is wide; 0.26 and less: a rim."},
};
inline constexpr SurfaceParameter kOfPane[] = {kReflected, kTransmitted, kIndex};

inline std::vector<float> tables_of_glass(float ior) {
    std::vector<float> tables = glass_albedo(ior);
    const std::vector<float> inside = glass_albedo(1.0f / ior);
    tables.insert(tables.end(), inside.begin(), inside.end());
    return tables;
}

}  // namespace surface_parameter

/// The kinds of surfaces, in the order of SurfaceKind.
inline constexpr auto kSurfaces = std::to_array<SurfaceInfo>({
    {.choice = {SurfaceKind::Diffuse, "diffuse", "Diffuse", "light in all directions alike"},
     .parameters = surface_parameter::kOfDiffuse,
     .text = "reflects {albedo}"},
    {.choice = {SurfaceKind::Conductor, "conductor", "Metal", "a mirror, or rough facets"},
     .color = &MaterialDescription::specular,
     // Within narrower lobes a cell of a 16 x 16 table tells nothing (docs/notebook/2026-11-29-rough-metals.md).
     .least_guided_roughness = 0.25f,
     .tables = [](float) { return lossless_albedo(); },
     .parameters = surface_parameter::kOfConductor,
     .text = "metal, reflects {specular}, {finish}{grain}"},
    {.choice = {SurfaceKind::Dielectric, "dielectric", "Glass", "solid glass or water, clear or frosted"},
     .color = &MaterialDescription::transmission,
     .least_guided_roughness = material_parameter::kNoLimit,
     .transmits = true,
     .has_inside = true,
     .tables = surface_parameter::tables_of_glass,
     .parameters = surface_parameter::kOfDielectric,
     .text = "glass of ior {ior}, transmits {transmission}, {finish}{absorbed}"},
    {.choice = {SurfaceKind::Plastic, "plastic", "Coated", "a diffuse base under a clear coat"},
     .effects = features(Feature::Plastic),
     .tables = coat_albedo,
     .has_smooth_tables = true,
     .parameters = surface_parameter::kOfPlastic,
     .text = "reflects {albedo} under a coat of ior {ior}, {finish}"},
    {.choice = {SurfaceKind::Pane, "pane", "Thin pane", "a sheet of clear glass without an inside"},
     .effects = features(Feature::ThinPanes),
     .color = &MaterialDescription::transmission,
     .least_guided_roughness = material_parameter::kNoLimit,
     .transmits = true,
     .parameters = surface_parameter::kOfPane,
     .text = "thin pane of ior {ior}, transmits {transmission}"},
    {.choice = {SurfaceKind::Velvet, "velvet", "Velvet", "a diffuse base under fibers, the sheen of cloth"},
     .effects = features(Feature::Velvet),
     .tables = [](float) { return sheen_albedo(); },
     .has_smooth_tables = true,
     .parameters = surface_parameter::kOfVelvet,
     .text = "reflects {albedo} under a sheen of {specular}, roughness {roughness}"},
});

template <>
inline constexpr auto kChoices<SurfaceKind> = [] {
    std::array<ChoiceInfo<SurfaceKind>, kSurfaces.size()> choices{};
    std::ranges::transform(kSurfaces, choices.begin(), &SurfaceInfo::choice);
    return choices;
}();

constexpr const SurfaceInfo& surface_info(SurfaceKind kind) { return kSurfaces[choice_index(kind)]; }
constexpr bool is_glass(SurfaceKind kind) { return surface_info(kind).transmits; }
constexpr bool has_inside(SurfaceKind kind) { return surface_info(kind).has_inside; }

}  // namespace pl
