#include "core/io/scene_materials.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "core/io/files.h"
#include "core/io/json_file.h"
#include "core/io/mtl.h"
#include "core/io/nearest_name.h"
#include "core/io/sky/sky_model.h"
#include "core/io/texture_file.h"
#include "core/scene/blends.h"
#include "core/scene/surface_info.h"

namespace pl {

namespace {

constexpr const char* kMaterialsSchema = "pathlight.materials/1";

/// Radiance, emission or absorption: three finite numbers of at least 0.
std::optional<glm::vec3> read_light(const JsonDocument& file, const std::string& pointer) {
    const std::optional<glm::vec3> value = file.vector(pointer);
    if (value && glm::any(glm::lessThan(*value, glm::vec3(0.0f)))) {
        file.fail(pointer, "expected numbers of at least 0");
    }
    return value;
}

std::optional<glm::vec3> read_share(const JsonDocument& file, const std::string& pointer) {
    const std::optional<glm::vec3> value = read_light(file, pointer);
    if (value && glm::any(glm::greaterThan(*value, glm::vec3(1.0f)))) {
        file.fail(pointer, "expected numbers within [0, 1]");
    }
    return value;
}

std::optional<float> read_within(const JsonDocument& file, const std::string& pointer, float least, float most) {
    const std::optional<float> value = file.number(pointer);
    if (value && !(*value >= least && *value <= most)) {
        file.fail(pointer, fmt::format("expected a number within [{}, {}], got {}", least, most, *value));
    }
    return value;
}

std::filesystem::path image_path(const JsonDocument& file, const SceneDescription& scene, const std::string& pointer,
                                 const std::string& name) {
    const std::filesystem::path path = path_inside(scene.source.parent_path(), name);
    if (path.empty()) {
        file.fail(pointer, fmt::format("expected a file in the folder of the scene, got '{}'", name));
    }
    return path;
}

/// Number of the material of this name; `pointer`: of the member with the name.
std::uint32_t find_material(const JsonDocument& file, const SceneDescription& scene, const std::string& pointer,
                            const std::string& name) {
    std::vector<std::string> names;
    for (std::uint32_t i = 0; i < scene.materials.size(); ++i) {
        if (scene.materials[i].name == name) {
            return i;
        }
        names.push_back(scene.materials[i].name);
    }
    file.fail(pointer, "the scene has no such material" + did_you_mean(name, names));
}

void read_parameter(const JsonDocument& file, const std::string& at, const MaterialParameter& parameter,
                    MaterialDescription& material) {
    const std::string pointer = at + "/" + parameter.name;
    if (parameter.color != nullptr) {
        glm::vec3& color = material.*parameter.color;
        color = (std::isfinite(parameter.most) ? read_share : read_light)(file, pointer).value_or(color);
    } else {
        float& number = material.*parameter.number;
        number = read_within(file, pointer, parameter.least, parameter.most).value_or(number);
    }
}

void read_surface(const JsonDocument& file, const std::string& at, MaterialDescription& material) {
    material.kind = file.choice<SurfaceKind>(at + "/surface").value_or(material.kind);
    for (const MaterialParameter* parameter : kMaterialParameters) read_parameter(file, at, *parameter, material);
    if (material.roughness < kLeastRoughness || material.kind == SurfaceKind::Pane) material.roughness = 0.0f;
}

/// Whether an image repeats outside of [0, 1].
bool read_wrap(const JsonDocument& file, const std::string& pointer, bool standard) {
    const std::string wrap = file.text(pointer).value_or(standard ? "repeat" : "clamp");
    if (wrap != "repeat" && wrap != "clamp") {
        file.fail(pointer, fmt::format("expected repeat or clamp, got '{}'", wrap));
    }
    return wrap == "repeat";
}

void read_images(const JsonDocument& file, const std::string& at, SceneDescription& scene, TextureUse& use) {
    const bool repeats = read_wrap(file, at + "/wrap", true);
    for (const MaterialImage& image : kMaterialImages) {
        const std::string pointer = at + "/" + image.name;
        const std::optional<std::string> name = file.text(pointer);
        const bool own_repeats = read_wrap(file, pointer + "_wrap", repeats);
        if (!name) {
            continue;
        }
        use.*image.texture =
            name->empty() ? kNoTexture
                          : add_texture(scene, image_path(file, scene, pointer, *name), image.content, own_repeats);
    }
}

/// A partial opacity blends unless the file says otherwise.
void read_opacity(const JsonDocument& file, const std::string& at, MaterialDescription& material) {
    const std::optional<float> opacity = read_within(file, at + "/opacity", 0.0f, 1.0f);
    const OpacityRule standard = opacity.value_or(1.0f) < 1.0f ? OpacityRule::Blend : material.opacity_rule;
    material.opacity = opacity.value_or(material.opacity);
    material.opacity_rule = file.choice<OpacityRule>(at + "/opacity_rule").value_or(standard);
}

void read_blend(const JsonDocument& file, const std::string& at, const SceneDescription& scene,
                BlendDescription& blend) {
    if (file.object(at, {"with", "share", "image", "image_wrap"}) == nullptr) {
        return;
    }
    if (const std::optional<std::string> with = file.text(at + "/with")) {
        blend.other = with->empty() ? kNoMaterial : find_material(file, scene, at + "/with", *with);
    } else if (!blend.is_any()) {
        file.fail(at, "expected 'with', the name of a material, got none");
    }
    blend.share = read_within(file, at + "/share", 0.0f, 1.0f).value_or(blend.share);
}

/// Chains of blends are known once all materials are read.
void check_blends(const JsonDocument& file, const SceneDescription& scene) {
    for (const MaterialDescription& material : scene.materials) {
        const std::string at = "/materials" + pointer_step(material.name) + "/blend";
        const std::string error = file.has(at) ? error_of_blend(scene.materials, material) : "";
        if (!error.empty()) {
            file.fail(at, error);
        }
    }
}

void read_sun(const JsonDocument& file, SunDescription& sun) {
    if (file.object("/environment/sun", {"direction", "radiance", "angle_deg"}) == nullptr) {
        return;
    }
    sun.direction = file.vector("/environment/sun/direction").value_or(sun.direction);
    if (sun.direction == glm::vec3(0.0f)) {
        file.fail("/environment/sun/direction", "expected a direction, got a vector of no length");
    }
    sun.radiance = read_light(file, "/environment/sun/radiance").value_or(glm::vec3(0.0f));
    sun.angle_deg =
        read_within(file, "/environment/sun/angle_deg", kLeastSunAngle, kMostSunAngle).value_or(sun.angle_deg);
}

void read_map(const JsonDocument& file, SceneDescription& scene) {
    const std::optional<std::string> name = file.text("/environment/map");
    const float scale = file.number("/environment/scale").value_or(1.0f);
    const float rotation_deg = file.number("/environment/rotation_deg").value_or(0.0f);
    if (scale < 0.0f) {
        file.fail("/environment/scale", fmt::format("expected a number of at least 0, got {}", scale));
    }
    if (name) {
        scene.environment_map = read_environment_map(image_path(file, scene, "/environment/map", *name), scale,
                                                     rotation_deg, scene.warnings);
    }
    for (int i = 0; i < 3 && file.has("/environment/axes"); ++i) {
        const auto axis = file.vector(fmt::format("/environment/axes/{}", i));
        if (!axis || file.array_size("/environment/axes") != 3)
            file.fail("/environment/axes", "expected the map's x, y and z in the world: three directions");
        scene.environment_map.axes[i] = *axis;
    }
}

void read_sky(const JsonDocument& file, SceneDescription& scene) {
    const std::string at = "/environment/sky";
    if (file.object(at, {"turbidity", "sun_direction", "up", "albedo", "scale", "sun_scale"}) == nullptr) return;
    for (const char* other : {"/environment/map", "/environment/sun"})
        if (file.has(other)) file.fail(at, fmt::format("expected a sky or {}, got both", other));
    const auto direction = [&](const char* key, const glm::vec3& standard) {
        const glm::vec3 given = file.vector(at + key).value_or(standard);
        if (given == glm::vec3(0.0f)) file.fail(at + key, "expected a direction, got a vector of no length");
        return glm::normalize(given);
    };
    SkyDescription sky;
    sky.up = direction("/up", sky.up);
    sky.sun_direction = direction("/sun_direction", sky.up);
    sky.turbidity = read_within(file, at + "/turbidity", kLeastTurbidity, kMostTurbidity).value_or(sky.turbidity);
    sky.albedo = read_share(file, at + "/albedo").value_or(sky.albedo);
    sky.sky_scale = read_within(file, at + "/scale", 0.0f, kMostSkyScale).value_or(sky.sky_scale);
    sky.sun_scale = read_within(file, at + "/sun_scale", 0.0f, kMostSkyScale).value_or(sky.sun_scale);
    add_sky(sky, scene);
}

}  // namespace

void read_materials(const JsonDocument& file, SceneDescription& scene) {
    const auto all = file.root().find("materials");
    if (all == file.root().end()) {
        return;
    }
    if (!all->is_object()) {
        file.fail("/materials", "expected an object { ... }");
    }
    std::vector<std::string> keys{"emission", "two_sided_emission", "surface",
                                  "wrap",     "normal_strength",    "normal_green",
                                  "opacity",  "opacity_rule",       "blend"};
    for (const MaterialImage& image : kMaterialImages) {
        if (std::string_view(image.name).find('/') != std::string_view::npos) continue;  // of a member's member
        keys.emplace_back(image.name);
        keys.push_back(keys.back() + "_wrap");
    }
    for (const MaterialParameter* parameter : kMaterialParameters) keys.emplace_back(parameter->name);
    for (const auto& [name, overrides] : all->items()) {
        const std::string at = "/materials" + pointer_step(name);
        file.object(at, keys);
        MaterialDescription& material = scene.materials[find_material(file, scene, at, name)];
        material.emission = read_light(file, at + "/emission").value_or(material.emission);
        material.two_sided_emission = file.boolean(at + "/two_sided_emission").value_or(material.two_sided_emission);
        read_surface(file, at, material);
        read_blend(file, at + "/blend", scene, material.blend);
        read_images(file, at, scene, material.textures);
        material.normal_strength =
            read_within(file, at + "/normal_strength", 0.0f, kMostNormalStrength).value_or(material.normal_strength);
        material.normal_green = file.choice<NormalGreen>(at + "/normal_green").value_or(material.normal_green);
        read_opacity(file, at, material);
    }
    check_blends(file, scene);
}

void read_material_file(const std::filesystem::path& path, SceneDescription& scene) {
    const JsonDocument file(read_text_file(path), path);
    file.object("", {"schema", "materials"});
    file.require_schema(kMaterialsSchema);
    read_materials(file, scene);
    scene.files.push_back(path);
}

Json material_json(const MaterialDescription& material) {
    Json json{{"surface", name_of(material.kind)},
              {"emission", vector_json(material.emission)},
              {"two_sided_emission", material.two_sided_emission},
              {"opacity", material.opacity},
              {"opacity_rule", name_of(material.opacity_rule)}};
    for (const MaterialParameter* parameter : kMaterialParameters)
        json[parameter->name] =
            parameter->color != nullptr ? vector_json(material.*parameter->color) : Json(material.*parameter->number);
    if (material.blend.is_any()) json["blend"] = {{"share", material.blend.share}};
    return json;
}

void write_material_file(const std::filesystem::path& path, const std::vector<MaterialDescription>& materials) {
    Json all = Json::object();
    for (const MaterialDescription& material : materials) {
        all[material.name] = material_json(material);
    }
    write_json_file(path, {{"schema", kMaterialsSchema}, {"materials", std::move(all)}});
}

void read_environment(const JsonDocument& file, SceneDescription& scene) {
    if (file.object("/environment", {"radiance", "map", "scale", "rotation_deg", "axes", "sun", "sky"}) == nullptr) {
        return;
    }
    scene.environment = read_light(file, "/environment/radiance").value_or(glm::vec3(0.0f));
    read_map(file, scene);
    read_sun(file, scene.sun);
    read_sky(file, scene);
}

}  // namespace pl
