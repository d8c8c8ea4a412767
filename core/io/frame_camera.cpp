#include "core/io/frame_camera.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <glm/gtc/constants.hpp>

#include "core/io/open_side.h"
#include "core/io/triangle_sums.h"
#include "core/scene/pack_scene.h"
#include "core/scene/up_axis.h"

namespace pl {

namespace {

/// Orthonormal axes of a picture; `back` points from the scene to the camera.
struct PictureAxes {
    glm::dvec3 right;
    glm::dvec3 up;
    glm::dvec3 back;
};

PictureAxes axes_towards(const glm::dvec3& back, const glm::dvec3& vertical) {
    const glm::dvec3 right = glm::normalize(glm::cross(vertical, back));
    return {right, glm::cross(back, right), back};
}

/// The sign of the direction from which more front-facing area is visible: -1 for the opposite one. +1 if the two differ
/// by less than a hundredth, because the two sides of a closed surface differ by rounding only.
double better_sign(const SceneDescription& scene, const glm::dvec3& direction) {
    glm::dvec2 front(0.0);  // projected area that faces the opposite, the direction
    for (const glm::dvec2& part : sums_of_triangles(scene, front, [&](glm::dvec2&sum, const auto&p) {
             const double area = 0.5 * glm::dot(glm::cross(p[1] - p[0], p[2] - p[0]), direction);
             sum[area > 0.0 ? 1 : 0] += std::abs(area);
         })) {
        front += part;
    }
    return front[0] > 1.01 * front[1] ? -1.0 : 1.0;
}

/// Unit direction from the scene to the camera.
glm::dvec3 good_side(const SceneDescription& scene) {
    if (const std::optional<glm::vec3> opening = open_side(scene)) {
        return glm::dvec3(*opening);
    }
    constexpr double kTurn = 35.0 * glm::pi<double>() / 180.0;
    constexpr double kLow = 20.0 * glm::pi<double>() / 180.0;
    constexpr double kHigh = 40.0 * glm::pi<double>() / 180.0;
    constexpr double kFlat = 0.3;  // height of a flat scene, relative to the smaller of its other sides
    const glm::dvec3 up(scene.up);
    const glm::dvec3 front(front_of(scene.up));
    const glm::dvec3 right = glm::cross(up, front);
    const Bounds bounds = bounds_of(scene);
    const glm::dvec3 extent = glm::dvec3(bounds.high) - glm::dvec3(bounds.low);
    const auto along = [&](const glm::dvec3& axis) { return std::abs(glm::dot(extent, axis)); };
    const double height = along(up) < kFlat * std::min(along(front), along(right)) ? kHigh : kLow;
    const glm::dvec3 level =
        std::cos(kTurn) * better_sign(scene, front) * front + std::sin(kTurn) * better_sign(scene, right) * right;
    return std::cos(height) * level + std::sin(height) * up;
}

/// The least distance from `center` at which all corners are within `tangent` of the middle of the picture.
double fitting_distance(const SceneDescription& scene, const PictureAxes& axes, const glm::dvec3& center,
                        double tangent) {
    struct Extremes {
        double fitting = 0.0;
        double nearest = 0.0;
        double farthest2 = 0.0;  ///< squared

        void add(const Extremes& other) {
            fitting = std::max(fitting, other.fitting);
            nearest = std::max(nearest, other.nearest);
            farthest2 = std::max(farthest2, other.farthest2);
        }
    };
    Extremes all;
    for (const Extremes& part : sums_of_triangles(scene, all, [&](Extremes&sum, const auto&corners) {
             for (const glm::dvec3& corner : corners) {
                 const glm::dvec3 p = corner - center;
                 const double depth = glm::dot(p, axes.back);
                 const double off = std::max(std::abs(glm::dot(p, axes.right)), std::abs(glm::dot(p, axes.up)));
                 sum.add({depth + off / tangent, depth, glm::dot(p, p)});
             }
         })) {
        all.add(part);
    }
    // With a wide angle, the camera would touch the surface.
    return std::max(all.fitting, all.nearest + 0.05 * std::sqrt(all.farthest2));
}

}  // namespace

CameraDescription frame_camera(const SceneDescription& scene, float fov_deg) {
    constexpr double kFilled = 0.9;  // share of the picture's side
    const PictureAxes axes = axes_towards(good_side(scene), glm::dvec3(scene.up));
    const Bounds bounds = bounds_of(scene);
    const glm::dvec3 center = 0.5 * (glm::dvec3(bounds.low) + glm::dvec3(bounds.high));
    const double tangent = std::tan(0.5 * static_cast<double>(fov_deg) * glm::pi<double>() / 180.0);
    // For a tiny object far from the origin: eye and target must differ as floats.
    const glm::dvec3 away = glm::abs(center);
    const double smallest =
        64.0 * std::max({away.x, away.y, away.z}) * static_cast<double>(std::numeric_limits<float>::epsilon());
    const double distance = std::max(fitting_distance(scene, axes, center, kFilled * tangent), smallest);

    CameraDescription camera;
    camera.eye = glm::vec3(center + distance * axes.back);
    camera.target = glm::vec3(center);
    camera.up = scene.up;
    camera.fov_deg = fov_deg;
    camera.focus_distance = static_cast<float>(distance);
    return camera;
}

}  // namespace pl
