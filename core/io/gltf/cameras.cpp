#include "core/io/gltf/cameras.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>

#include "core/scene/pack_scene.h"

namespace pl {
namespace {

/// Distance to a target within or before the scene, so far that eye and target differ as floats.
double target_distance(const Bounds& bounds, const glm::dvec3& eye, const glm::dvec3& forward) {
    const glm::dvec3 low(bounds.low);
    const glm::dvec3 high(bounds.high);
    const double to_center = glm::dot(0.5 * (low + high) - eye, forward);
    const double size = glm::length(high - low);
    const glm::dvec3 away = glm::abs(eye);
    const double least =
        64.0 * std::max({away.x, away.y, away.z}) * static_cast<double>(std::numeric_limits<float>::epsilon());
    return std::max({to_center, 0.1 * size, least});
}

/// A camera looks along -z of its node. [glTF 2.0, section 3.10]
std::optional<CameraDescription> place_camera(const GltfNode& node, float fov_deg, const Bounds& bounds) {
    const glm::dvec3 back(node.to_world[2]);
    const glm::dvec3 up(node.to_world[1]);
    if (!(glm::length(back) > 0.0) || !(glm::length(up) > 0.0)) return std::nullopt;
    const glm::dvec3 eye(node.to_world[3]);
    const glm::dvec3 forward = -glm::normalize(back);
    const double distance = target_distance(bounds, eye, forward);
    CameraDescription camera;
    camera.eye = glm::vec3(eye);
    camera.target = glm::vec3(eye + distance * forward);
    camera.up = glm::vec3(glm::normalize(up));
    camera.fov_deg = fov_deg;
    camera.focus_distance = static_cast<float>(distance);
    return camera;
}

/// Full vertical angle in degrees.
float field_of_view(const GltfFile& file, const std::string& at) {
    const std::string pointer = at + "/perspective/yfov";
    const double radians = static_cast<double>(file.json().number(pointer).value_or(0.0f));
    if (!(radians > 0.0 && radians < glm::pi<double>()))
        file.fail(pointer, fmt::format("expected an angle within (0, pi) radians, got {}", radians));
    return std::min(static_cast<float>(radians * 180.0 / glm::pi<double>()), 179.9f);
}

}  // namespace

void add_gltf_cameras(GltfFile& file, const GltfNodes& nodes, SceneDescription& scene) {
    const Bounds bounds = bounds_of(scene);
    for (const std::uint32_t number : nodes.shown) {
        const GltfNode& node = nodes.all[number];
        if (!node.camera) continue;
        const std::string at = fmt::format("/cameras/{}", *node.camera);
        if (file.json().text(at + "/type") != "perspective") {
            file.note("cameras without perspective are left out", at);
            continue;
        }
        const std::optional<CameraDescription> camera = place_camera(node, field_of_view(file, at), bounds);
        if (!camera) {
            file.note("cameras whose node has no extent are left out", at);
            continue;
        }
        scene.cameras.push_back({.name = node.name,
                                 .camera = *camera,
                                 .aspect = file.json().number(at + "/perspective/aspectRatio").value_or(0.0f)});
    }
}

}  // namespace pl
