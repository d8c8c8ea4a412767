#include "core/fields/surfaces.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>

#include "core/scene/triangle_planes.h"

namespace pl {
namespace {

/// Triangles around each distinct position, as one array with offsets.
struct Corners {
    std::vector<std::uint32_t> point_of;   ///< [vertex], number of its position
    std::vector<std::uint32_t> start;      ///< [point]; one more than there are points
    std::vector<std::uint32_t> triangles;  ///< ascending for each point
};

/// Vertices at equal positions get the same number. +0 and -0 are equal.
std::vector<std::uint32_t> number_positions(const std::vector<Vec3f>& positions, std::uint32_t& points) {
    std::vector<std::uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto less = [&](std::uint32_t a, std::uint32_t b) {
        const Vec3f p = positions[a];
        const Vec3f q = positions[b];
        if (p.x != q.x) return p.x < q.x;
        return p.y != q.y ? p.y < q.y : p.z < q.z;
    };
    std::sort(order.begin(), order.end(), less);
    std::vector<std::uint32_t> number(positions.size());
    points = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i > 0 && less(order[i - 1], order[i])) ++points;
        number[order[i]] = points;
    }
    if (!order.empty()) ++points;
    return number;
}

Corners collect_corners(const HostScene& scene) {
    Corners corners;
    std::uint32_t points = 0;
    corners.point_of = number_positions(scene.positions, points);
    corners.start.assign(points + 1, 0);
    for (const Triangle& t : scene.triangles)
        for (const std::uint32_t v : {t.v0, t.v1, t.v2}) ++corners.start[corners.point_of[v] + 1];
    std::partial_sum(corners.start.begin(), corners.start.end(), corners.start.begin());
    corners.triangles.resize(corners.start.back());
    std::vector<std::uint32_t> next(corners.start.begin(), corners.start.end() - 1);
    for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
        const Triangle& t = scene.triangles[i];
        for (const std::uint32_t v : {t.v0, t.v1, t.v2}) corners.triangles[next[corners.point_of[v]]++] = i;
    }
    return corners;
}

class SurfaceGrower {
public:
    explicit SurfaceGrower(const HostScene& scene)
        : scene_(scene), view_(scene.view()), corners_(collect_corners(scene)) {
        found_.of_triangle.assign(scene.triangles.size(), kNoSurface);
        last_visitor_.assign(corners_.start.size(), kNoSurface);
    }

    Surfaces grow_all() {
        for (std::uint32_t i = 0; i < scene_.triangles.size(); ++i)
            if (found_.of_triangle[i] == kNoSurface && can_carry(i)) grow(i);
        return std::move(found_);
    }

private:
    bool can_carry(std::uint32_t triangle) const {
        return scene_.materials[scene_.triangles[triangle].material].reflects() && area_of(view_, triangle) > 0.0;
    }

    void grow(std::uint32_t seed) {
        const auto number = static_cast<std::uint32_t>(found_.list.size());
        Surface surface;
        surface.triangles.push_back(seed);
        found_.of_triangle[seed] = number;
        for (std::size_t next = 0; next < surface.triangles.size(); ++next) {
            const Triangle& t = scene_.triangles[surface.triangles[next]];
            for (const std::uint32_t v : {t.v0, t.v1, t.v2}) add_around(corners_.point_of[v], seed, number, surface);
        }
        std::sort(surface.triangles.begin(), surface.triangles.end());
        for (const std::uint32_t triangle : surface.triangles) surface.area += area_of(view_, triangle);
        found_.list.push_back(std::move(surface));
    }

    /// Each surface visits the triangles around each point once, so that a fan of a million triangles takes linear
    /// time.
    void add_around(std::uint32_t point, std::uint32_t seed, std::uint32_t number, Surface& surface) {
        if (last_visitor_[point] == number) return;
        last_visitor_[point] = number;
        for (std::uint32_t i = corners_.start[point]; i < corners_.start[point + 1]; ++i) {
            const std::uint32_t triangle = corners_.triangles[i];
            if (found_.of_triangle[triangle] != kNoSurface || !can_carry(triangle)) continue;
            if (glm::dot(view_.planes[triangle].normal, view_.planes[seed].normal) < kMinSurfaceCosine) continue;
            found_.of_triangle[triangle] = number;
            surface.triangles.push_back(triangle);
        }
    }

    const HostScene& scene_;
    SceneView view_;
    Corners corners_;
    Surfaces found_;
    std::vector<std::uint32_t> last_visitor_;  ///< [point], the last surface that visited it
};

}  // namespace

double area_of(const SceneView& scene, std::uint32_t triangle) {
    return 0.5 * glm::length(TriangleCorners(scene.positions, scene.triangles[triangle]).cross());
}

Surfaces find_surfaces(const HostScene& scene) { return SurfaceGrower(scene).grow_all(); }

}  // namespace pl
