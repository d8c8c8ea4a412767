#include "core/io/scene_json.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

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

PunctualKind read_kind(const JsonDocument& file, const std::string& at) {
    const std::string name = file.text(at + "/type").value_or("");
    for (const PunctualKind kind : {PunctualKind::Point, PunctualKind::Spot, PunctualKind::Directional})
        if (name == name_of(kind)) return kind;
    file.fail(at + "/type", fmt::format("expected point, spot or directional, got '{}'", name));
}

SpotFalloff read_falloff(const JsonDocument& file, const std::string& at) {
    const std::string name = file.text(at + "/falloff").value_or("cosine");
    for (const SpotFalloff falloff : {SpotFalloff::Cosine, SpotFalloff::Angle})
        if (name == name_of(falloff)) return falloff;
    file.fail(at + "/falloff", fmt::format("expected cosine or angle, got '{}'", name));
}

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
    light.falloff = read_falloff(file, at);
    if (!are_cones(light.inner_deg, light.outer_deg))
        file.fail(at, fmt::format("expected 0 <= inner_deg <= outer_deg, and 0 < outer_deg <= {}, got {} and {}",
                                  kMostSpotAngle, light.inner_deg, light.outer_deg));
}

PunctualLightDescription read_punctual_light(const JsonDocument& file, const std::string& at) {
    PunctualLightDescription light{.kind = read_kind(file, at)};
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
    const bool given = file.object("/camera", std::vector<std::string>(kCameraMembers.begin(), kCameraMembers.end()));
    read_up(file, asked, scene);
    if (file.has("/cameras")) {
        scene.cameras = read_named_cameras(file, frame_camera(scene, CameraDescription{}.fov_deg));
    }
    if (!given) {
        set_default_camera(scene);
        return;
    }
    const float fov_deg = file.number("/camera/fov_deg").value_or(CameraDescription{}.fov_deg);
    if (!(fov_deg > 0.0f && fov_deg < 180.0f)) {
        file.fail("/camera/fov_deg", fmt::format("expected an angle within (0, 180) degrees, got {}", fov_deg));
    }
    scene.camera = frame_camera(scene, fov_deg);
    scene.camera.eye = file.point("/camera/eye").value_or(scene.camera.eye);
    scene.camera.target = file.point("/camera/target").value_or(scene.camera.target);
    scene.camera.up = file.vector("/camera/up").value_or(scene.camera.up);
    if (scene.camera.eye == scene.camera.target) {
        file.fail("/camera/eye", "eye and target are the same point");
    }
    scene.camera.shift = {file.number("/camera/shift_x").value_or(0.0f),
                          file.number("/camera/shift_y").value_or(0.0f)};
    scene.camera.is_mirrored = file.boolean("/camera/mirrored").value_or(false);
    scene.camera.aperture_radius = file.number("/camera/aperture_radius").value_or(0.0f);
    if (scene.camera.aperture_radius < 0.0f) {
        file.fail("/camera/aperture_radius", "expected a number of at least 0");
    }
    const double to_target = glm::length(glm::dvec3(scene.camera.target) - glm::dvec3(scene.camera.eye));
    const auto sharp_there = static_cast<float>(std::min(to_target, double{std::numeric_limits<float>::max()}));
    scene.camera.focus_distance = file.number("/camera/focus_distance").value_or(sharp_there);
    if (!(scene.camera.focus_distance > 0.0f)) {
        file.fail("/camera/focus_distance", "expected a number above 0");
    }
}

ObjNormals read_normals(const JsonDocument& file) {
    const std::string lengths = file.text("/normals").value_or("any");
    if (lengths != "any" && lengths != "unit") {
        file.fail("/normals", fmt::format("expected any or unit, got '{}'", lengths));
    }
    return lengths == "unit" ? ObjNormals::Unit : ObjNormals::Any;
}

MapKd read_map_kd(const JsonDocument& file) {
    const std::string name = file.text("/map_kd").value_or(std::string(name_of(MapKd::Multiplies)));
    const std::optional<MapKd> choice = choice_named<MapKd>(name);
    if (!choice) {
        file.fail("/map_kd", fmt::format("expected {}, got '{}'", fmt::join(choice_names<MapKd>(), " or "), name));
    }
    return *choice;
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
    const std::optional<std::string> schema = file.text("/schema");
    if (schema != kSchema) {
        file.fail("/schema",
                  fmt::format("expected \"{}\", got {}", kSchema, schema ? "\"" + *schema + "\"" : "none"));
    }
    const std::optional<std::string> obj = file.text("/obj");
    if (!obj || obj->empty()) {
        file.fail("/obj", "expected the name of an OBJ or glTF file");
    }
    // Groups make the loader copy meshes: knobs move groups, and the image of vertex colors has a texel for each copy's vertex.
    const bool needs_groups = file.has("/knobs") || file.has("/vertex_colors");
    MeshGroups groups;
    SceneDescription scene = load_mesh(path.parent_path() / *obj, needs_groups ? &groups : nullptr, asked,
                                       read_map_kd(file), read_normals(file));
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
