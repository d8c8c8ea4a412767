#include "core/fields/surfaces.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/base/parallel.h"
#include "core/kernel/shading/blends.h"
#include "core/scene/position_numbers.h"
#include "core/scene/triangle_planes.h"

namespace pl {
namespace {

/// Triangles around each distinct position, as one array with offsets.
struct Corners {
    std::vector<std::uint32_t> point_of;   ///< [vertex], number of its position
    std::vector<std::uint32_t> start;      ///< [point]; one more than there are points
    std::vector<std::uint32_t> triangles;  ///< ascending for each point
};

Corners collect_corners(const HostScene& scene) {
    Corners corners;
    PositionNumbers numbers(scene.positions.size());
    corners.point_of.reserve(scene.positions.size());
    for (const Vec3f& position : scene.positions) corners.point_of.push_back(numbers.number_of(position));
    corners.start.assign(numbers.count() + 1, 0);
    const auto triangles = static_cast<std::uint32_t>(scene.planes.size());
    for (std::uint32_t i = 0; i < triangles; ++i) {
        const Triangle& t = scene.triangles[i];
        for (const std::uint32_t v : {t.v0, t.v1, t.v2}) ++corners.start[corners.point_of[v] + 1];
    }
    std::partial_sum(corners.start.begin(), corners.start.end(), corners.start.begin());
    corners.triangles.resize(corners.start.back());
    std::vector<std::uint32_t> next(corners.start.begin(), corners.start.end() - 1);
    for (std::uint32_t i = 0; i < triangles; ++i) {
        const Triangle& t = scene.triangles[i];
        for (const std::uint32_t v : {t.v0, t.v1, t.v2}) corners.triangles[next[corners.point_of[v]]++] = i;
    }
    return corners;
}

/// Whether a material reflects diffusely, or one that it blends with.
bool may_reflect(const SceneView& scene, std::uint32_t material) {
    for (std::uint32_t choice = 0;; ++choice) {
        if (scene.materials[material].reflects()) return true;
        if (scene.blends.empty() || choice == kMostBlends || scene.blends[material].other == kNoBlend) return false;
        material = scene.blends[material].other;
    }
}

class SurfaceGrower {
public:
    SurfaceGrower(const HostScene& scene, int threads)
        : scene_(scene), view_(scene.view()), corners_(collect_corners(scene)), areas_(scene.planes.size()) {
        for_indices(view_.direct_triangles(), threads, [&](std::uint32_t i) {
            if (may_reflect(view_, scene_.triangles[i].material)) areas_[i] = area_of(view_, i);
        });
        found_.of_triangle.assign(scene.planes.size(), kNoSurface);
        last_visitor_.assign(corners_.start.size(), kNoSurface);
    }

    Surfaces grow_all() {
        for (std::uint32_t i = 0; i < view_.direct_triangles(); ++i)
            if (found_.of_triangle[i] == kNoSurface && areas_[i] > 0.0) grow(i);
        for (std::uint32_t i = 0; i < view_.direct_triangles(); ++i)
            if (const std::uint32_t number = found_.of_triangle[i]; number != kNoSurface) {
                found_.list[number].triangles.push_back(i);
                found_.list[number].area += areas_[i];
            }
        return std::move(found_);
    }

private:
    void grow(std::uint32_t seed) {
        const auto number = static_cast<std::uint32_t>(found_.list.size());
        reached_.assign(1, seed);
        found_.of_triangle[seed] = number;
        for (std::size_t next = 0; next < reached_.size(); ++next) {
            const Triangle& t = scene_.triangles[reached_[next]];
            for (const std::uint32_t v : {t.v0, t.v1, t.v2}) add_around(corners_.point_of[v], seed, number);
        }
        found_.list.emplace_back().triangles.reserve(reached_.size());
    }

    /// Each surface visits the triangles around each point once, so that a fan of a million triangles takes linear
    /// time.
    void add_around(std::uint32_t point, std::uint32_t seed, std::uint32_t number) {
        if (last_visitor_[point] == number) return;
        last_visitor_[point] = number;
        for (std::uint32_t i = corners_.start[point]; i < corners_.start[point + 1]; ++i) {
            const std::uint32_t triangle = corners_.triangles[i];
            if (found_.of_triangle[triangle] != kNoSurface || !(areas_[triangle] > 0.0)) continue;
            if (glm::dot(view_.planes[triangle].normal, view_.planes[seed].normal) < kMinSurfaceCosine) continue;
            found_.of_triangle[triangle] = number;
            reached_.push_back(triangle);
        }
    }

    const HostScene& scene_;
    SceneView view_;
    Corners corners_;
    std::vector<double> areas_;  ///< [triangle]; 0 where it reflects nothing
    Surfaces found_;
    std::vector<std::uint32_t> reached_;       ///< triangles of the surface that grows
    std::vector<std::uint32_t> last_visitor_;  ///< [point], the last surface that visited it
};

}  // namespace

double area_of(const SceneView& scene, std::uint32_t triangle) {
    return 0.5 * glm::length(TriangleCorners(scene.positions, scene.triangles[triangle]).cross());
}

Surfaces find_surfaces(const HostScene& scene, int threads) { return SurfaceGrower(scene, threads).grow_all(); }

}  // namespace pl
