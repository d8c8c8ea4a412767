// `pathlight info`: what a scene holds, and what it takes to render it.
#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/commands.h"
#include "app/make_backend.h"
#include "app/open_scene.h"
#include "app/parse_values.h"
#include "core/scene/needed_effects.h"
#include "core/scene/pack_light_tree.h"
#include "core/scene/pack_scene.h"
#include "core/scene/scene_hash.h"
#include "core/session/session.h"

namespace pl {
namespace {

Json vector_json(const glm::vec3& v) { return Json::array({v.x, v.y, v.z}); }

bool has_lobe(const MaterialDescription& material, bool rough) {
    return material.kind != SurfaceKind::Diffuse && (material.roughness > 0.0f) == rough;
}

/// "of 2 materials: mirror, window"
template <class Pick>
std::string materials_that(const SceneDescription& scene, Pick pick) {
    std::vector<std::string> names;
    for (const MaterialDescription& material : scene.materials)
        if (pick(material)) names.push_back(material.name);
    return fmt::format("of {} material{}: {}", names.size(), names.size() == 1 ? "" : "s", fmt::join(names, ", "));
}

/// Light from far away that depends on the direction, in words.
std::string far_lights_of(const SceneDescription& scene) {
    const EnvironmentMapDescription& map = scene.environment_map;
    std::vector<std::string> parts;
    if (!map.texels.empty())
        parts.push_back(fmt::format("the environment is an image of {}x{}", map.width, map.height));
    if (scene.sun.radiance != glm::vec3(0.0f))
        parts.push_back(fmt::format("a sun of {} degrees shines", print_float(scene.sun.angle_deg)));
    return fmt::format("{}", fmt::join(parts, ", "));
}

std::ptrdiff_t triangles_that_emit(const SceneDescription& scene) {
    return std::count_if(scene.triangles.begin(), scene.triangles.end(), [&](const TriangleDescription& triangle) {
        return scene.materials[triangle.material].emission != glm::vec3{0.0f};
    });
}

/// Why an effect is needed, in words.
std::string reason_of(Feature feature, const SceneDescription& scene) {
    switch (feature) {
    case Feature::SmoothNormals: {
        const auto smooth = std::count_if(scene.triangles.begin(), scene.triangles.end(), [](const auto& triangle) {
            return triangle.normal.x != TriangleDescription::kNoNormal;
        });
        return fmt::format("{} triangles have normals of their own", smooth);
    }
    case Feature::Environment:
        return fmt::format("the environment shines with radiance {}", print_vector(scene.environment));
    case Feature::NextEventEstimation: return "asked for by --nee on";
    case Feature::Specular: return materials_that(scene, [](const auto& m) { return has_lobe(m, false); });
    case Feature::Rough: return materials_that(scene, [](const auto& m) { return has_lobe(m, true); });
    case Feature::Plastic: return materials_that(scene, [](const auto& m) { return m.kind == SurfaceKind::Plastic; });
    case Feature::Textures: return materials_that(scene, [](const auto& m) { return m.textures.any(); });
    case Feature::CutOuts:
        return materials_that(scene, [](const auto& m) { return m.textures.opacity != kNoTexture; });
    case Feature::EnvironmentMap: return far_lights_of(scene);
    case Feature::ThinLens: return fmt::format("the camera's lens has a radius of {}", scene.camera.aperture_radius);
    case Feature::ManyLights:
        return fmt::format("{} triangles emit light, more than {}", triangles_that_emit(scene), kFewLights);
    }
    return "";
}

struct Effect {
    std::string name;
    std::string reason;
};

std::vector<Effect> effects_of(FeatureSet needed, const SceneDescription& scene) {
    std::vector<Effect> effects;
    for (const Feature feature : kAllFeatures)
        if (needed.has(feature))
            effects.push_back({effect_names(FeatureSet{}.with(feature)).front(), reason_of(feature, scene)});
    return effects;
}

/// Everything that `info` tells.
struct SceneReport {
    const SceneDescription& scene;
    const HostScene& packed;
    Bounds bounds;
    std::vector<Effect> effects;
    std::vector<std::string> compiled;
    std::string kernel;
};

double bytes_per_triangle(const HostScene& scene) {
    const std::size_t triangles = scene.triangles.size();
    return triangles == 0 ? 0.0 : static_cast<double>(bytes_of(scene)) / static_cast<double>(triangles);
}

std::string text_of(const SceneReport& report) {
    const SceneDescription& scene = report.scene;
    const CameraDescription& camera = scene.camera;
    std::string text = fmt::format("name       {}\nfile       {}\nhash       {}\n", scene.name, scene.source.string(),
                                   scene_hash(scene));
    text += fmt::format("triangles  {}\nlights     {} triangles\nmaterials  {}\n", scene.triangles.size(),
                        report.packed.lights.size(), scene.materials.size());
    for (const MaterialDescription& material : scene.materials)
        text += fmt::format("           {}: reflects {}, emits {}{}\n", material.name, print_vector(material.albedo),
                            print_vector(material.emission), material.two_sided_emission ? " on both sides" : "");
    text += fmt::format("memory     {} bytes, {:.0f} per triangle\n", bytes_of(report.packed),
                        bytes_per_triangle(report.packed));
    text += fmt::format("knobs      {}\n", scene.knobs.empty() ? "none" : "");
    for (const KnobDescription& knob : scene.knobs)
        text +=
            fmt::format("           {}={} (from {} to {}, default {}): {}\n", knob.name, print_float(knob.value),
                        print_float(knob.low), print_float(knob.high), print_float(knob.default_value), knob.does);
    text += fmt::format("bounds     {} to {}\n", print_vector(report.bounds.low), print_vector(report.bounds.high));
    text += fmt::format("camera     eye {}, target {}, up {}, fov {} degrees\n", print_vector(camera.eye),
                        print_vector(camera.target), print_vector(camera.up), print_float(camera.fov_deg));
    text += fmt::format("effects    {}\n", report.effects.empty() ? "none needed" : "");
    for (const Effect& effect : report.effects)
        text += fmt::format("           {}: {}\n", effect.name, effect.reason);
    text += fmt::format("kernel     {} (compiled for: {})\n", report.kernel,
                        report.compiled.empty() ? "no effects" : fmt::format("{}", fmt::join(report.compiled, ", ")));
    return text;
}

Json json_of(const SceneReport& report) {
    const SceneDescription& scene = report.scene;
    Json materials = Json::array();
    for (const MaterialDescription& material : scene.materials)
        materials.push_back({{"name", material.name},
                             {"albedo", vector_json(material.albedo)},
                             {"emission", vector_json(material.emission)},
                             {"two_sided_emission", material.two_sided_emission}});
    Json knobs = Json::array();
    for (const KnobDescription& knob : scene.knobs)
        knobs.push_back({{"name", knob.name},
                         {"value", knob.value},
                         {"default", knob.default_value},
                         {"range", Json::array({knob.low, knob.high})},
                         {"does", knob.does}});
    Json effects = Json::array();
    for (const Effect& effect : report.effects) effects.push_back({{"name", effect.name}, {"reason", effect.reason}});
    return {{"name", scene.name},
            {"file", scene.source.string()},
            {"scene_hash", scene_hash(scene)},
            {"triangles", scene.triangles.size()},
            {"lights", report.packed.lights.size()},
            {"materials", materials},
            {"bytes", bytes_of(report.packed)},
            {"bytes_per_triangle", bytes_per_triangle(report.packed)},
            {"knobs", knobs},
            {"bounds", {{"low", vector_json(report.bounds.low)}, {"high", vector_json(report.bounds.high)}}},
            {"camera",
             {{"eye", vector_json(scene.camera.eye)},
              {"target", vector_json(scene.camera.target)},
              {"up", vector_json(scene.camera.up)},
              {"fov_deg", scene.camera.fov_deg},
              {"aperture_radius", scene.camera.aperture_radius},
              {"focus_distance", scene.camera.focus_distance}}},
            {"effects_needed", effects},
            {"effects_compiled", report.compiled},
            {"kernel", report.kernel}};
}

}  // namespace

int run_info(const CommandLine& line, Console& console) {
    const LoadedScene loaded = open_scene(line.options.scene, line.options.knobs, console);
    const Options options = resolve_options(line, *loaded.scene);
    const HostScene packed = pack_scene(*loaded.scene);
    const FeatureSet needed = needed_features(packed, options.render);
    const ServedKernel kernel =
        served_kernel(make_backend(options.backend, options.threads)->info().name, packed, options.render);
    const SceneReport report{.scene = *loaded.scene,
                             .packed = packed,
                             .bounds = bounds_of(*loaded.scene),
                             .effects = effects_of(needed, *loaded.scene),
                             .compiled = effect_names(kernel.compiled),
                             .kernel = kernel.name};
    console.result(text_of(report));
    console.event("info", json_of(report));
    return 0;
}

}  // namespace pl
