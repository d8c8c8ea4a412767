#include "core/scene/needed_effects.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/scene/pack_steps.h"
#include "core/scene/punctual_lights.h"
#include "core/scene/surface_info.h"

namespace pl {
namespace {

/// Effects of the non-diffuse lobes of a material.
FeatureSet effects_of(const SurfaceLobes& lobes) {
    if (lobes.kind == SurfaceKind::Diffuse) return {};
    return surface_info(lobes.kind).effects.with(lobes.roughness > 0.0f ? Feature::Rough : Feature::Specular);
}

bool has_lobe(const MaterialDescription& material, bool rough) {
    return material.kind != SurfaceKind::Diffuse && (material.roughness > 0.0f) == rough;
}

template <class Pick>
std::string materials_that(const SceneDescription& scene, Pick pick) {
    std::vector<std::string> names;
    for (const MaterialDescription& material : scene.materials)
        if (pick(material)) names.push_back(material.name);
    return fmt::format("of {} material{}: {}", names.size(), names.size() == 1 ? "" : "s", fmt::join(names, ", "));
}

/// Names of the far lights of a scene.
std::string far_lights_of(const SceneDescription& scene) {
    const EnvironmentMapDescription& map = scene.environment_map;
    std::vector<std::string> parts;
    if (scene.default_light)
        parts.push_back("the scene has no light of its own: the default light shines");
    else if (!map.texels.empty())
        parts.push_back(fmt::format("the environment is an image of {}x{}", map.width, map.height));
    if (scene.sun.radiance != glm::vec3(0.0f))
        parts.push_back(fmt::format("a sun of {} degrees shines", scene.sun.angle_deg));
    return fmt::format("{}", fmt::join(parts, ", "));
}

std::string smooth_normals_of(const SceneDescription& scene) {
    const auto smooth = std::count_if(scene.triangles.begin(), scene.triangles.end(), [](const auto& triangle) {
        return triangle.normal.x != TriangleDescription::kNoNormal;
    });
    return fmt::format("{} triangles have normals of their own", smooth);
}

std::string many_lights_of(const SceneDescription& scene) {
    const auto emitting = std::count_if(scene.triangles.begin(), scene.triangles.end(), [&](const auto& triangle) {
        return scene.materials[triangle.material].emission != glm::vec3{0.0f};
    });
    return fmt::format("{} triangles emit light, more than {}", emitting, kFewLights);
}

std::string instances_of(const SceneDescription& scene) {
    return fmt::format("{} instances show {} mesh{}", scene.instances.size(), scene.meshes.size(),
                       scene.meshes.size() == 1 ? "" : "es");
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

std::string reason_of(Feature feature, const SceneDescription& scene, const CameraDescription& camera) {
    const glm::vec3& sky = scene.environment;
    switch (feature) {
    case Feature::SmoothNormals: return smooth_normals_of(scene);
    case Feature::Environment:
        return fmt::format("the environment shines with radiance {},{},{}", sky.x, sky.y, sky.z);
    case Feature::NextEventEstimation: return "requested by --nee on";
    case Feature::Specular: return materials_that(scene, [](const auto& m) { return has_lobe(m, false); });
    case Feature::Rough: return materials_that(scene, [](const auto& m) { return has_lobe(m, true); });
    case Feature::Textures:
        return materials_that(scene, [](const auto& m) { return m.textures.any(); }) +
               (scene.vertex_colors.empty() ? "" : "; vertices have colors");
    case Feature::CutOuts: return materials_that(scene, [](const auto& m) { return m.may_have_holes(); });
    case Feature::EnvironmentMap: return far_lights_of(scene);
    case Feature::ThinLens: return fmt::format("the camera's lens has a radius of {}", camera.aperture_radius);
    case Feature::ManyLights: return many_lights_of(scene);
    case Feature::NormalMaps:
        return materials_that(scene, [](const auto& m) { return m.textures.normal != kNoTexture; });
    case Feature::DeltaLights: return count_text(scene.punctual_lights);
    case Feature::Blends: return materials_that(scene, [](const auto& m) { return m.blend.is_any(); });
    case Feature::Anisotropy: return materials_that(scene, [](const auto& m) { return m.is_anisotropic(); });
    case Feature::Absorption: return materials_that(scene, [](const auto& m) { return m.absorbs(); });
    case Feature::Instances: return instances_of(scene);
    default: return materials_that(scene, [&](const auto& m) { return surface_info(m.kind).effects.has(feature); });
    }
}

}  // namespace pl
