#include "core/scene/needed_effects.h"

#include <string_view>

namespace pl {

namespace {

/// Effects of the non-diffuse lobes of a material.
FeatureSet effects_of(const SurfaceLobes& lobes) {
    if (lobes.kind == SurfaceKind::Diffuse) return {};
    const FeatureSet set = features(lobes.roughness > 0.0f ? Feature::Rough : Feature::Specular);
    if (lobes.kind == SurfaceKind::Pane) return set.with(Feature::ThinPanes);
    return lobes.kind == SurfaceKind::Plastic ? set.with(Feature::Plastic) : set;
}

std::string_view name_of(Feature feature) {
    switch (feature) {
    case Feature::SmoothNormals: return "smooth-normals";
    case Feature::Environment: return "environment";
    case Feature::NextEventEstimation: return "next-event-estimation";
    case Feature::Specular: return "specular";
    case Feature::Rough: return "rough";
    case Feature::Plastic: return "plastic";
    case Feature::Textures: return "textures";
    case Feature::CutOuts: return "cut-outs";
    case Feature::EnvironmentMap: return "environment-map";
    case Feature::ThinLens: return "thin-lens";
    case Feature::ManyLights: return "many-lights";
    case Feature::NormalMaps: return "normal-maps";
    case Feature::DeltaLights: return "delta-lights";
    case Feature::Absorption: return "absorption";
    case Feature::ThinPanes: return "thin-panes";
    case Feature::Blends: return "blends";
    case Feature::Anisotropy: return "anisotropy";
    case Feature::Instances: return "instances";
    }
    return "";
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
    for (const Feature feature : kAllFeatures)
        if (set.has(feature)) names.emplace_back(name_of(feature));
    return names;
}

}  // namespace pl
