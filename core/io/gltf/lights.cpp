#include "core/io/gltf/lights.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>

#include "core/scene/punctual_lights.h"

namespace pl {
namespace {

/// Lumens of a watt in files of Blender's exporter, in its default unit.
constexpr double kLumensPerWatt = 683.0;

/// Radiant intensity of points and spots, irradiance of directional lights.
glm::vec3 intensity_of(GltfFile& file, const std::string& at) {
    const double intensity = static_cast<double>(file.json().number(at + "/intensity").value_or(1.0f));
    const auto color = file.json().numbers(at + "/color", 3);
    const glm::dvec3 tint = color ? glm::dvec3((*color)[0], (*color)[1], (*color)[2]) : glm::dvec3(1.0);
    if (!(intensity >= 0.0) || glm::any(glm::lessThan(tint, glm::dvec3(0.0))))
        file.fail(at, "expected a color and an intensity of at least 0");
    const bool is_of_blender = file.json().text("/asset/generator").value_or("").find("Blender") != std::string::npos;
    return glm::vec3(tint * intensity / (is_of_blender ? kLumensPerWatt : 1.0));
}

/// False if the light has no cone. Cones that glTF does not allow have a meaning nevertheless: the falloff is one of the
/// cosine, for any angle.
bool read_cones(GltfFile& file, const std::string& at, PunctualLightDescription& light) {
    const float inner = file.json().number(at + "/spot/innerConeAngle").value_or(0.0f);
    const float outer = file.json().number(at + "/spot/outerConeAngle").value_or(glm::quarter_pi<float>());
    light.outer_deg = std::min(glm::degrees(outer), kMostSpotAngle);
    light.inner_deg = std::clamp(glm::degrees(inner), 0.0f, std::max(light.outer_deg, 0.0f));
    if (outer > glm::pi<float>() || !(inner >= 0.0f && inner <= outer))
        file.note("cones of spots are moved to 0 <= innerConeAngle <= outerConeAngle <= pi", at);
    light.falloff = SpotFalloff::Cosine;
    return light.outer_deg > 0.0f;
}

std::optional<PunctualKind> kind_of(const std::string& type) {
    for (const PunctualKind kind : {PunctualKind::Point, PunctualKind::Spot, PunctualKind::Directional})
        if (type == name_of(kind)) return kind;
    return std::nullopt;
}

/// A light shines along -z of its node.
void add_light(GltfFile& file, const GltfNode& node, const std::string& at, SceneDescription& scene) {
    const std::string type = file.json().text(at + "/type").value_or("none");
    const std::optional<PunctualKind> kind = kind_of(type);
    if (!kind) return file.note(fmt::format("lights of the type {} are left out", type), at);
    const glm::dvec3 back(node.to_world[2]);
    if (*kind != PunctualKind::Point && !(glm::length(back) > 0.0))
        return file.note("lights whose node has no extent are left out", at);
    PunctualLightDescription light{.kind = *kind, .position = glm::vec3(node.to_world[3])};
    light.intensity = intensity_of(file, at);
    if (*kind != PunctualKind::Point) light.direction = glm::vec3(-glm::normalize(back));
    if (*kind == PunctualKind::Spot && !read_cones(file, at, light))
        return file.note("spots without a cone are left out", at);
    if (*kind != PunctualKind::Directional && file.json().number(at + "/range"))
        file.note("ranges of lights are left out: light falls off by the square of the distance alone", at);
    scene.punctual_lights.push_back(light);
}

}  // namespace

void add_gltf_lights(GltfFile& file, const GltfNodes& nodes, SceneDescription& scene) {
    for (const std::uint32_t number : nodes.shown) {
        const GltfNode& node = nodes.all[number];
        if (node.light)
            add_light(file, node, fmt::format("/extensions/KHR_lights_punctual/lights/{}", *node.light), scene);
    }
}

}  // namespace pl
