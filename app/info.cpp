// `pathlight info`: the contents of a scene, the effects that it needs and the kernel that serves it.
#include <fmt/args.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/commands.h"
#include "app/make_backend.h"
#include "app/open_scene.h"
#include "app/parse_values.h"
#include "core/io/camera_file.h"
#include "core/scene/default_light.h"
#include "core/scene/instances.h"
#include "core/scene/needed_effects.h"
#include "core/scene/pack_scene.h"
#include "core/scene/punctual_lights.h"
#include "core/scene/scene_hash.h"
#include "core/scene/surface_info.h"
#include "core/session/session.h"

namespace pl {
namespace {

std::vector<EffectRow> effects_of(FeatureSet needed, const SceneDescription& scene) {
    std::vector<EffectRow> effects;
    for (const Feature feature : kAllFeatures)
        if (needed.has(feature))
            effects.push_back(
                {effect_names(FeatureSet{}.with(feature)).front(), reason_of(feature, scene, scene.camera)});
    return effects;
}

std::string opacity_text(const MaterialDescription& material) {
    return material.opacity < 1.0f ? fmt::format(", opacity {}", print_float(material.opacity)) : "";
}

std::string blend_text(const SceneDescription& scene, const MaterialDescription& material) {
    if (!material.blend.is_any()) return "";
    return fmt::format(", blend of {} {}{}", print_float(material.blend.share),
                       scene.materials[material.blend.other].name,
                       material.textures.blend == kNoTexture ? "" : " times an image");
}

/// The light that a material sends back, and how.
std::string surface_text(const MaterialDescription& m) {
    fmt::dynamic_format_arg_store<fmt::format_context> values;
    const auto add = [&](const char* name, const std::string& text) { values.push_back(fmt::arg(name, text)); };
    for (const MaterialParameter* parameter : kMaterialParameters)
        add(parameter->name,
            parameter->color != nullptr ? print_vector(m.*parameter->color) : print_float(m.*parameter->number));
    add("finish", m.roughness == 0.0f ? "smooth" : "roughness " + print_float(m.roughness));
    add("grain", m.is_anisotropic() ? fmt::format(", anisotropy {} at {} degrees", print_float(m.anisotropy),
                                                  print_float(m.rotation_deg))
                                    : "");
    add("absorbed", m.absorbs() ? fmt::format(", absorbs {} per length", print_vector(m.absorption)) : "");
    return fmt::vformat(surface_info(m.kind).text, values);
}

/// The content of the output.
struct SceneReport {
    const SceneDescription& scene;
    const HostScene& packed;
    std::string hash;
    Bounds bounds;
    std::vector<EffectRow> effects;
    std::vector<std::string> compiled;
    std::string kernel;
};

double bytes_per_triangle(const HostScene& scene) {
    const std::size_t triangles = scene.triangles.size();
    return triangles == 0 ? 0.0 : static_cast<double>(bytes_of(scene)) / static_cast<double>(triangles);
}

std::string counted(std::size_t count, const char* one, const char* many) {
    return fmt::format("{} {}", count, count == 1 ? one : many);
}

std::string triangles_text(const SceneDescription& scene) {
    if (scene.instances.empty()) return fmt::format("{}", scene.triangles.size());
    const std::uint32_t direct = direct_triangles(scene);
    return fmt::format("{} directly, {} of {} shown by {}: {} in all", direct, scene.triangles.size() - direct,
                       counted(scene.meshes.size(), "mesh", "meshes"),
                       counted(scene.instances.size(), "instance", "instances"), shown_triangles(scene));
}

std::string report_text(const SceneReport& report) {
    const SceneDescription& scene = report.scene;
    const CameraDescription& camera = scene.camera;
    std::string text =
        fmt::format("name       {}\nsummary    {}\nfile       {}\nhash       {}\n", scene.name,
                    scene.summary.empty() ? "nothing said" : scene.summary, scene.source.string(), report.hash);
    text += fmt::format("triangles  {}\nlights     {} triangles\nmaterials  {}\n", triangles_text(scene),
                        report.packed.lights.size(), scene.materials.size());
    for (const MaterialDescription& material : scene.materials)
        text += fmt::format("           {}: {}{}, emits {}{}{}\n", material.name, surface_text(material),
                            blend_text(scene, material), print_vector(material.emission),
                            material.two_sided_emission ? " on both sides" : "", opacity_text(material));
    text += fmt::format("light      {}\n", light_text(scene));
    if (!scene.punctual_lights.empty()) text += fmt::format("           {}\n", count_text(scene.punctual_lights));
    text += fmt::format("memory     {} bytes, {:.0f} per triangle\n", bytes_of(report.packed),
                        bytes_per_triangle(report.packed));
    text += fmt::format("knobs      {}\n", scene.knobs.empty() ? "none" : "");
    for (const KnobDescription& knob : scene.knobs)
        text +=
            fmt::format("           {}={} (from {} to {}, default {}): {}\n", knob.name, print_float(knob.value),
                        print_float(knob.low), print_float(knob.high), print_float(knob.default_value), knob.does);
    text += fmt::format("bounds     {} to {}\n", print_vector(report.bounds.low), print_vector(report.bounds.high));
    if (scene.origin != glm::dvec3(0.0))
        text += fmt::format("origin     {} {} {} in the file's coordinates: all others here count from it\n",
                            scene.origin.x, scene.origin.y, scene.origin.z);
    text += fmt::format("camera     eye {}, target {}, up {}, fov {} degrees\n", print_vector(camera.eye),
                        print_vector(camera.target), print_vector(camera.up), print_float(camera.fov_deg));
    for (std::size_t i = 0; i < scene.cameras.size(); ++i)
        text += fmt::format("           --camera {}: {}{}\n", i + 1, scene.cameras[i].name,
                            scene.chosen_camera == i + 1 ? " (this one)" : "");
    text += fmt::format("effects    {}\n", report.effects.empty() ? "none needed" : "");
    for (const EffectRow& effect : report.effects)
        text += fmt::format("           {}: {}\n", effect.name, effect.reason);
    text += fmt::format("kernel     {} (compiled for: {})\n", report.kernel,
                        report.compiled.empty() ? "no effects" : fmt::format("{}", fmt::join(report.compiled, ", ")));
    return text;
}

void add_instances(const SceneDescription& scene, Json& json) {
    if (scene.instances.empty()) return;
    json["meshes"] = scene.meshes.size();
    json["instances"] = scene.instances.size();
    json["shown_triangles"] = shown_triangles(scene);
}

Json json_of(const SceneReport& report) {
    const SceneDescription& scene = report.scene;
    Json materials = Json::array();
    for (const MaterialDescription& material : scene.materials)
        materials.push_back({{"name", material.name},
                             {"surface", name_of(material.kind)},
                             {"albedo", vector_json(material.albedo)},
                             {"specular", vector_json(material.specular)},
                             {"transmission", vector_json(material.transmission)},
                             {"roughness", material.roughness},
                             {"ior", material.ior},
                             {"emission", vector_json(material.emission)},
                             {"two_sided_emission", material.two_sided_emission}});
    Json knobs = Json::array();
    for (const KnobDescription& knob : scene.knobs)
        knobs.push_back({{"name", knob.name},
                         {"value", knob.value},
                         {"default", knob.default_value},
                         {"range", Json::array({knob.low, knob.high})},
                         {"does", knob.does}});
    Json cameras = Json::array();
    for (const NamedCamera& camera : scene.cameras) cameras.push_back(camera.name);
    Json effects = Json::array();
    for (const EffectRow& effect : report.effects)
        effects.push_back({{"name", effect.name}, {"reason", effect.reason}});
    Json json{{"name", scene.name},
              {"summary", scene.summary},
              {"file", scene.source.string()},
              {"scene_hash", report.hash},
              {"triangles", scene.triangles.size()},
              {"lights", report.packed.lights.size()},
              {"light", name_of(light_of(scene))},
              {"punctual_lights", scene.punctual_lights.size()},
              {"materials", materials},
              {"bytes", bytes_of(report.packed)},
              {"bytes_per_triangle", bytes_per_triangle(report.packed)},
              {"knobs", knobs},
              {"bounds", {{"low", vector_json(report.bounds.low)}, {"high", vector_json(report.bounds.high)}}},
              {"origin", {scene.origin.x, scene.origin.y, scene.origin.z}},
              {"camera", camera_json(scene.camera)},
              {"cameras", cameras},
              {"effects_needed", effects},
              {"effects_compiled", report.compiled},
              {"kernel", report.kernel}};
    add_instances(scene, json);
    return json;
}

}  // namespace

int run_info(const CommandLine& line, Console& console) {
    const LoadedScene loaded = open_scene(line.options.scene, line.options.load, console);
    const Options options = resolve_options(line, *loaded.scene);
    const HostScene packed = pack_scene(*loaded.scene);
    const FeatureSet needed = needed_features(packed, options.render);
    const ServedKernel kernel =
        served_kernel(make_own_backend(options.backend, options.threads)->info().name, needed, options.render);
    const SceneReport report{.scene = *loaded.scene,
                             .packed = packed,
                             .hash = scene_hash(*loaded.scene),
                             .bounds = bounds_of(*loaded.scene),
                             .effects = effects_of(needed, *loaded.scene),
                             .compiled = effect_names(kernel.compiled),
                             .kernel = kernel.name};
    console.result(report_text(report));
    console.event("info", json_of(report));
    return 0;
}

}  // namespace pl
