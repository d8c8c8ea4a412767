#include "core/io/gltf/lights.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>

namespace pl {
namespace {

/// Lumens of a watt in files of Blender's exporter, in its default unit.
constexpr double kLumensPerWatt = 683.0;

/// Irradiance on a surface that faces a directional light.
glm::dvec3 irradiance_of(GltfFile& file, const std::string& at) {
    const double intensity = static_cast<double>(file.json().number(at + "/intensity").value_or(1.0f));
    const auto color = file.json().numbers(at + "/color", 3);
    const glm::dvec3 tint = color ? glm::dvec3((*color)[0], (*color)[1], (*color)[2]) : glm::dvec3(1.0);
    if (!(intensity >= 0.0) || glm::any(glm::lessThan(tint, glm::dvec3(0.0))))
        file.fail(at, "expected a color and an intensity of at least 0");
    const bool is_of_blender = file.json().text("/asset/generator").value_or("").find("Blender") != std::string::npos;
    return tint * intensity / (is_of_blender ? kLumensPerWatt : 1.0);
}

/// A light shines along -z of its node.
void set_sun(GltfFile& file, const GltfNode& node, const std::string& at, SunDescription& sun) {
    const glm::dvec3 towards(node.to_world[2]);
    if (!(glm::length(towards) > 0.0)) {
        file.note("lights whose node has no extent are left out", at);
        return;
    }
    const double half_angle = 0.5 * static_cast<double>(sun.angle_deg) * glm::pi<double>() / 180.0;
    const double projected_solid_angle = glm::pi<double>() * std::sin(half_angle) * std::sin(half_angle);
    sun.direction = glm::vec3(glm::normalize(towards));
    sun.radiance = glm::vec3(irradiance_of(file, at) / projected_solid_angle);
}

}  // namespace

void add_gltf_lights(GltfFile& file, const GltfNodes& nodes, SceneDescription& scene) {
    for (const std::uint32_t number : nodes.shown) {
        const GltfNode& node = nodes.all[number];
        if (!node.light) continue;
        const std::string at = fmt::format("/extensions/KHR_lights_punctual/lights/{}", *node.light);
        const std::string type = file.json().text(at + "/type").value_or("none");
        if (type != "directional")
            file.note(fmt::format("lights of the type {} are left out", type), at);
        else if (scene.sun.radiance != glm::vec3(0.0f))
            file.note("directional lights after the first one, the sun, are left out", at);
        else
            set_sun(file, node, at, scene.sun);
    }
}

}  // namespace pl
