#include "core/io/scene_json.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/io/camera_file.h"
#include "core/io/files.h"
#include "core/io/frame_camera.h"
#include "core/io/image.h"
#include "core/io/json_document.h"
#include "core/io/load_scene.h"
#include "core/io/scene_knobs.h"
#include "core/io/scene_materials.h"
#include "core/io/texture_file.h"
#include "core/scene/punctual_lights.h"

namespace pl {
namespace {

glm::vec3 required(const JsonDocument& file, const std::string& pointer, const std::optional<glm::vec3>& value) {
    if (!value) file.fail(pointer, "expected three numbers, got none");
    return *value;
}

glm::vec3 required_vector(const JsonDocument& file, const std::string& pointer) {
    return required(file, pointer, file.vector(pointer));
}

void read_direction(const JsonDocument& file, const std::string& pointer, PunctualLightDescription& light) {
    light.direction = required_vector(file, pointer);
    if (light.direction == glm::vec3(0.0f)) file.fail(pointer, "expected a direction, got a vector of no length");
}

void read_cones(const JsonDocument& file, const std::string& at, PunctualLightDescription& light) {
    light.inner_deg = file.number(at + "/inner_deg").value_or(light.inner_deg);
    light.outer_deg = file.number(at + "/outer_deg").value_or(light.outer_deg);
    light.falloff = file.choice<SpotFalloff>(at + "/falloff").value_or(light.falloff);
    if (!are_cones(light.inner_deg, light.outer_deg))
        file.fail(at, fmt::format("expected 0 <= inner_deg <= outer_deg, and 0 < outer_deg <= {}, got {} and {}",
                                  kMostSpotAngle, light.inner_deg, light.outer_deg));
}

PunctualLightDescription read_punctual_light(const JsonDocument& file, const std::string& at) {
    const auto kind = file.choice<PunctualKind>(at + "/type");
    if (!kind) file.fail(at + "/type", "expected the kind of the light, got none");
    PunctualLightDescription light{.kind = *kind};
    switch (light.kind) {
    case PunctualKind::Point: file.object(at, {"type", "position", "intensity"}); break;
    case PunctualKind::Spot:
        file.object(at, {"type", "position", "direction", "intensity", "inner_deg", "outer_deg", "falloff"});
        break;
    case PunctualKind::Directional: file.object(at, {"type", "direction", "irradiance"}); break;
    }
    const bool is_far = light.kind == PunctualKind::Directional;
    const std::string strength = at + (is_far ? "/irradiance" : "/intensity");
    light.intensity = required_vector(file, strength);
    if (glm::any(glm::lessThan(light.intensity, glm::vec3(0.0f))))
        file.fail(strength, "expected numbers of at least 0");
    if (!is_far) light.position = required(file, at + "/position", file.point(at + "/position"));
    if (light.kind != PunctualKind::Point) read_direction(file, at + "/direction", light);
    if (light.kind == PunctualKind::Spot) read_cones(file, at, light);
    return light;
}

}  // namespace

void read_punctual_lights(const JsonDocument& file, SceneDescription& scene) {
    const auto all = file.root().find("lights");
    if (all != file.root().end() && !all->is_array()) file.fail("/lights", "expected an array [ ... ]");
    for (std::size_t i = 0; i < file.array_size("/lights"); ++i)
        scene.punctual_lights.push_back(read_punctual_light(file, fmt::format("/lights/{}", i)));
}

Json punctual_light_json(const PunctualLightDescription& light) {
    Json json{{"type", name_of(light.kind)}};
    const bool is_far = light.kind == PunctualKind::Directional;
    json[is_far ? "irradiance" : "intensity"] = vector_json(light.intensity);
    if (!is_far) json["position"] = vector_json(light.position);
    if (light.kind != PunctualKind::Point) json["direction"] = vector_json(light.direction);
    if (light.kind != PunctualKind::Spot) return json;
    json["inner_deg"] = light.inner_deg;
    json["outer_deg"] = light.outer_deg;
    json["falloff"] = name_of(light.falloff);
    return json;
}

namespace {

constexpr const char* kSchema = "pathlight.scene/1";

/// Options that a scene may preset: those that affect the picture, not output and reporting.
const std::vector<std::string> kSettings = {"method",       "view",         "backend",   "threads",       "spp",
                                            "time-limit",   "target-error", "width",     "height",        "size",
                                            "seed",         "nee",          "max-depth", "exposure",      "tonemap",
                                            "field-budget", "volumes",      "bins",      "bsdf-fraction", "learn",
                                            "field",        "roulette",     "guiding",   "default-light", "up-axis"};

/// The vertical axis: of the choice, else of the settings, else of the camera, else guessed. Expects scene.settings.
void read_up(const JsonDocument& file, const LoadSettings& asked, SceneDescription& scene) {
    const std::optional<UpAxis> preset = choice_named<UpAxis>(scene.setting("up-axis"));
    const UpAxis axis = asked.up_axis.value_or(preset.value_or(UpAxis::Auto));
    const std::string at = file.has("/camera") ? "/camera" : "/cameras/0";
    const std::optional<glm::vec3> up = file.vector(at + "/up");
    const bool places_camera = file.vector(at + "/eye") || file.vector(at + "/target");
    if (axis == UpAxis::Auto && up && *up != glm::vec3(0.0f)) {
        scene.up = nearest_axis(*up);
    } else if (axis != UpAxis::Auto || !places_camera) {
        scene.up = up_direction(axis, scene);
    }
}

void read_camera(const JsonDocument& file, const LoadSettings& asked, SceneDescription& scene) {
    read_up(file, asked, scene);
    constexpr CameraDescription kStandard;
    if (file.has("/cameras")) {
        scene.cameras = read_named_cameras(file, frame_camera(scene, kStandard.fov_deg));
    }
    if (!file.has("/camera")) {
        set_default_camera(scene);
        return;
    }
    CameraChoice given;
    read_camera_parts(file, "/camera", given);
    const CameraDescription framed = frame_camera(scene, given.fov_deg.value_or(kStandard.fov_deg));
    scene.camera = whole_camera(file, "/camera", framed, given);
    if (given.focus_distance) return;
    const double to_target = glm::length(glm::dvec3(scene.camera.target) - glm::dvec3(scene.camera.eye));
    scene.camera.focus_distance = static_cast<float>(std::min(to_target, double{std::numeric_limits<float>::max()}));
}

/// The texels of an image, row by row from the top, are the colors of the vertices.
void read_vertex_colors(const JsonDocument& file, SceneDescription& scene) {
    const std::string pointer = "/vertex_colors";
    const std::optional<std::string> name = file.text(pointer);
    if (!name) {
        return;
    }
    const std::filesystem::path path = path_inside(scene.source.parent_path(), *name);
    if (path.empty()) {
        file.fail(pointer, fmt::format("expected a file in the folder of the scene, got '{}'", *name));
    }
    scene.vertex_colors = read_linear(path, nullptr, &scene.warnings).pixels;
    if (scene.vertex_colors.size() < scene.positions.size()) {
        file.fail(pointer, fmt::format("expected an image with a texel for each of {} vertices, got {}",
                                       scene.positions.size(), scene.vertex_colors.size()));
    }
    scene.vertex_colors.resize(scene.positions.size());
    scene.files.push_back(path);
}

void read_settings(const JsonDocument& file, SceneDescription& scene) {
    const Json* const settings = file.object("/settings", kSettings);
    if (settings == nullptr) {
        return;
    }
    for (const auto& [name, value] : settings->items()) {
        if (value.is_string()) {
            scene.settings.emplace_back(name, value.get<std::string>());
        } else if (value.is_boolean()) {
            scene.settings.emplace_back(name, value.get<bool>() ? "on" : "off");
        } else if (value.is_number()) {
            scene.settings.emplace_back(name, value.dump());
        } else {
            file.fail("/settings" + pointer_step(name), "expected a number, a text, true or false");
        }
    }
}

}  // namespace

SceneDescription load_scene_json(const std::filesystem::path& path, const LoadSettings& asked) {
    JsonDocument file(read_text_file(path), path);
    file.object("", {"schema", "name", "summary", "obj", "normals", "map_kd", "vertex_colors", "camera", "cameras",
                     "environment", "lights", "materials", "knobs", "settings"});
    file.require_schema(kSchema);
    const std::optional<std::string> obj = file.text("/obj");
    if (!obj || obj->empty()) {
        file.fail("/obj", "expected the name of an OBJ or glTF file");
    }
    // Groups make the loader copy meshes: knobs move groups, and the image of vertex colors has a texel for each copy's vertex.
    const bool needs_groups = file.has("/knobs") || file.has("/vertex_colors");
    MeshGroups groups;
    SceneDescription scene = load_mesh(path.parent_path() / *obj, needs_groups ? &groups : nullptr, asked,
                                       file.choice<MapKd>("/map_kd").value_or(MapKd::Multiplies),
                                       file.choice<ObjNormals>("/normals").value_or(ObjNormals::Any));
    file.count_from(scene.origin);
    scene.source = path;
    scene.files.push_back(path);
    scene.name = file.text("/name").value_or(path.stem().string());
    scene.summary = file.text("/summary").value_or("");
    read_vertex_colors(file, scene);
    read_materials(file, scene);
    read_knobs(file, scene, groups, asked.parameters);
    read_environment(file, scene);
    read_punctual_lights(file, scene);
    read_settings(file, scene);
    read_camera(file, asked, scene);
    return scene;
}

}  // namespace pl
