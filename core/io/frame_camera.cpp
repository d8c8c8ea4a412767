#include "core/io/frame_camera.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/gtc/constants.hpp>

namespace pl {

namespace {

/// Side of the scene (+1: +z) with the larger front-facing area; +1 if they differ by less than a hundredth, because
/// the two sides of a closed surface differ by rounding only.
double better_side(const SceneDescription& scene) {
    double front[2] = {0.0, 0.0};  // projected area facing -z, +z
    for (const TriangleDescription& triangle : scene.triangles) {
        const glm::dvec2 a(scene.positions[triangle.vertex.x]);
        const glm::dvec2 b = glm::dvec2(scene.positions[triangle.vertex.y]) - a;
        const glm::dvec2 c = glm::dvec2(scene.positions[triangle.vertex.z]) - a;
        const double area = 0.5 * (b.x * c.y - b.y * c.x);
        front[area > 0.0 ? 1 : 0] += std::abs(area);
    }
    return front[0] > 1.01 * front[1] ? -1.0 : 1.0;
}

}  // namespace

CameraDescription frame_camera(const SceneDescription& scene, float fov_deg) {
    glm::vec3 low(std::numeric_limits<float>::max());
    glm::vec3 high(std::numeric_limits<float>::lowest());
    for (const TriangleDescription& triangle : scene.triangles) {
        for (int k = 0; k < 3; ++k) {
            const glm::vec3 p = scene.positions[triangle.vertex[k]];
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
    }
    const glm::dvec3 center = 0.5 * (glm::dvec3(low) + glm::dvec3(high));
    const double radius = 0.5 * glm::length(glm::dvec3(high) - glm::dvec3(low));
    const double half_angle = 0.5 * static_cast<double>(fov_deg) * glm::pi<double>() / 180.0;
    // For a tiny object far from the origin: eye and target must differ as floats.
    const double smallest = 16.0 * std::abs(center.z) * static_cast<double>(std::numeric_limits<float>::epsilon());
    const double distance = std::max(radius / std::sin(half_angle), smallest);

    CameraDescription camera;
    camera.eye = glm::vec3(center + glm::dvec3(0.0, 0.0, better_side(scene) * distance));
    camera.target = glm::vec3(center);
    camera.up = {0.0f, 1.0f, 0.0f};
    camera.fov_deg = fov_deg;
    camera.focus_distance = static_cast<float>(distance);
    return camera;
}

}  // namespace pl
