#include "core/scene/needed_effects.h"

#include "core/scene/surface_info.h"

namespace pl {
namespace {

/// Effects of the non-diffuse lobes of a material.
FeatureSet effects_of(const SurfaceLobes& lobes) {
    if (lobes.kind == SurfaceKind::Diffuse) return {};
    return surface_info(lobes.kind).effects.with(lobes.roughness > 0.0f ? Feature::Rough : Feature::Specular);
}

}  // namespace

FeatureSet needed_effects(const HostScene& scene) {
    FeatureSet set;
    if (!scene.triangle_normals.empty()) set = set.with(Feature::SmoothNormals);
    if (!is_black(scene.environment)) set = set.with(Feature::Environment);
    for (const SurfaceLobes& lobes : scene.lobes) set = set.with(effects_of(lobes));
    if (!scene.images.empty() || !scene.vertex_colors.empty()) set = set.with(Feature::Textures);
    if (!scene.opacities.empty()) set = set.with(Feature::CutOuts);
    if (!scene.blends.empty()) set = set.with(Feature::Blends);
    if (!scene.anisotropies.empty()) set = set.with(Feature::Anisotropy);
    if (!scene.instances.empty()) set = set.with(Feature::Instances);
    if (!scene.normal_maps.empty()) set = set.with(Feature::NormalMaps);
    if (!scene.light_nodes.empty()) set = set.with(Feature::ManyLights);
    if (!scene.delta_lights.empty()) set = set.with(Feature::DeltaLights);
    if (!scene.absorption.empty()) set = set.with(Feature::Absorption);
    if (scene.far_probability > 0.0f) set = set.with(Feature::EnvironmentMap);
    return set;
}

FeatureSet needed_effects(const CameraDescription& camera) {
    return camera.aperture_radius > 0.0f ? features(Feature::ThinLens) : FeatureSet{};
}

std::vector<std::string> effect_names(FeatureSet set) {
    std::vector<std::string> names;
    for (const FeatureInfo& info : kAllFeatures)
        if (set.has(info)) names.emplace_back(info.name);
    return names;
}

}  // namespace pl
