#include "core/io/frame_camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <glm/gtc/constants.hpp>

#include "core/scene/pack_scene.h"
#include "core/scene/up_axis.h"

namespace pl {
namespace {

/// For parallel rays along an axis through the scene's bounds: the first and the last surface that each meets.
/// Coordinates are relative to the bounds, from 0 to 1.
class DepthGrid {
public:
    explicit DepthGrid(int axis) : axis_(axis), across_((axis + 1) % 3), along_((axis + 2) % 3) {
        first_.fill(std::numeric_limits<double>::infinity());
        last_.fill(-std::numeric_limits<double>::infinity());
    }

    void add(const std::array<glm::dvec3, 3>& corners) {
        const glm::dvec2 a = flat(corners[0]);
        const glm::dvec2 ab = flat(corners[1]) - a;
        const glm::dvec2 ac = flat(corners[2]) - a;
        const double area = ab.x * ac.y - ab.y * ac.x;
        if (!(std::abs(area) > 0.0)) return;  // edge-on, or not finite, which validate_scene() tells
        const glm::dvec2 low = a + glm::min(glm::dvec2(0.0), glm::min(ab, ac));
        const glm::dvec2 high = a + glm::max(glm::dvec2(0.0), glm::max(ab, ac));
        for (int row = first_ray(low.y); row <= last_ray(high.y); ++row)
            for (int column = first_ray(low.x); column <= last_ray(high.x); ++column) {
                const glm::dvec2 p = (glm::dvec2(column, row) + 0.5) / double{kOpenSideGrid} - a;
                const double b = (p.x * ac.y - p.y * ac.x) / area;
                const double c = (ab.x * p.y - ab.y * p.x) / area;
                if (b < 0.0 || c < 0.0 || b + c > 1.0) continue;
                meet(row * kOpenSideGrid + column,
                     glm::mix(corners[0][axis_], corners[1][axis_], b) + c * (corners[2][axis_] - corners[0][axis_]));
            }
    }

    void add(const DepthGrid& other) {
        for (std::size_t i = 0; i < first_.size(); ++i) {
            first_[i] = std::min(first_[i], other.first_[i]);
            last_[i] = std::max(last_[i], other.last_[i]);
        }
    }

    /// Mean depth behind the side of the bounds that `sign` points to; 0 if too many rays meet nothing.
    double mean_depth(double sign) const {
        constexpr double kCovered = 0.9;
        double sum = 0.0;
        int count = 0;
        for (std::size_t i = 0; i < first_.size(); ++i) {
            if (!(first_[i] <= last_[i])) continue;
            sum += sign > 0.0 ? 1.0 - last_[i] : first_[i];
            ++count;
        }
        return count >= kCovered * static_cast<double>(first_.size()) ? sum / count : 0.0;
    }

private:
    glm::dvec2 flat(const glm::dvec3& p) const { return {p[across_], p[along_]}; }
    static int first_ray(double low) { return std::max(0, static_cast<int>(std::ceil(low * kOpenSideGrid - 0.5))); }
    static int last_ray(double high) {
        return std::min(kOpenSideGrid - 1, static_cast<int>(std::floor(high * kOpenSideGrid - 0.5)));
    }
    void meet(int ray, double depth) {
        const auto i = static_cast<std::size_t>(ray);
        first_[i] = std::min(first_[i], depth);
        last_[i] = std::max(last_[i], depth);
    }

    int axis_;
    int across_;
    int along_;
    std::array<double, std::size_t{kOpenSideGrid} * kOpenSideGrid> first_;
    std::array<double, std::size_t{kOpenSideGrid} * kOpenSideGrid> last_;
};

/// The grids of the two horizontal axes, the grid of front_of(scene.up) first.
using DepthGrids = std::array<DepthGrid, 2>;

DepthGrids depth_grids(const SceneDescription& scene, const Bounds& bounds, const DepthGrids& empty) {
    const glm::dvec3 low(bounds.low);
    const glm::dvec3 extent = glm::max(glm::dvec3(bounds.high) - low, std::numeric_limits<double>::min());
    DepthGrids grids = empty;
    for (const DepthGrids& part : sums_of_triangles(scene, empty, [&](DepthGrids&sums, auto corners) {
             for (glm::dvec3& corner : corners) corner = (corner - low) / extent;
             for (DepthGrid& grid : sums) grid.add(corners);
         })) {
        for (std::size_t i = 0; i < grids.size(); ++i) grids[i].add(part[i]);
    }
    return grids;
}

int axis_of(const glm::vec3& direction) { return direction.x != 0.0f ? 0 : direction.y != 0.0f ? 1 : 2; }

}  // namespace

std::optional<glm::vec3> open_side(const SceneDescription& scene) {
    constexpr float kLeastDepth = 0.1f;  // of a box, relative to its largest side: nothing flatter is one
    const Bounds bounds = bounds_of(scene);
    const glm::vec3 extent = bounds.high - bounds.low;
    const glm::vec3 front = front_of(scene.up);
    const glm::vec3 right = glm::cross(scene.up, front);
    const DepthGrids grids = depth_grids(scene, bounds, {DepthGrid(axis_of(front)), DepthGrid(axis_of(right))});
    double deepest = 0.5;
    std::optional<glm::vec3> side;
    for (const glm::vec3& toward : {front, right}) {
        const int axis = axis_of(toward);
        if (extent[axis] < kLeastDepth * std::max({extent.x, extent.y, extent.z})) continue;
        const DepthGrid& grid = grids[toward == front ? 0 : 1];
        for (const glm::vec3& out : {toward, -toward}) {
            const double depth = grid.mean_depth(static_cast<double>(out[axis]));
            if (depth <= deepest) continue;
            deepest = depth;
            side = out;
        }
    }
    return side;
}

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
