#include "core/io/open_side.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/io/triangle_sums.h"
#include "core/scene/pack_scene.h"
#include "core/scene/up_axis.h"

namespace pl {
namespace {

/// For parallel rays along an axis through the scene's bounds: the first and the last surface that each meets. Coordinates
/// are those of the bounds, from 0 to 1.
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

/// The grids of the two horizontal axes: that of front_of(scene.up) first.
struct DepthGrids {
    DepthGrid first;
    DepthGrid second;
};

DepthGrids depth_grids(const SceneDescription& scene, const Bounds& bounds, const DepthGrids& empty) {
    const glm::dvec3 low(bounds.low);
    const glm::dvec3 extent = glm::max(glm::dvec3(bounds.high) - low, std::numeric_limits<double>::min());
    DepthGrids grids = empty;
    for (const DepthGrids& part : sums_of_triangles(scene, empty, [&](DepthGrids&sums, auto corners) {
             for (glm::dvec3& corner : corners) corner = (corner - low) / extent;
             sums.first.add(corners);
             sums.second.add(corners);
         })) {
        grids.first.add(part.first);
        grids.second.add(part.second);
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
        const DepthGrid& grid = toward == front ? grids.first : grids.second;
        for (const glm::vec3& out : {toward, -toward}) {
            const double depth = grid.mean_depth(static_cast<double>(out[axis]));
            if (depth <= deepest) continue;
            deepest = depth;
            side = out;
        }
    }
    return side;
}

}  // namespace pl
