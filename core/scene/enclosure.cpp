#include "core/scene/enclosure.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "core/scene/blends.h"
#include "core/scene/connections.h"
#include "core/scene/instances.h"
#include "core/scene/position_numbers.h"
#include "core/scene/surface_info.h"

namespace pl {
namespace {

struct Edge {
    std::uint32_t low;
    std::uint32_t high;
    std::uint32_t triangle;

    auto ends() const { return std::tie(low, high); }
};

/// Opaque: neither glass, nor a blend with it, nor with holes or partial opacity.
bool is_solid(const SceneDescription& scene, std::uint32_t material) {
    if (scene.materials[material].may_have_holes()) return false;
    return !any_shown(scene.materials, material, [](const MaterialDescription& m) { return is_glass(m.kind); });
}

/// Edges of all opaque direct triangles with an area, sorted by their ends.
std::vector<Edge> edges_of(const SceneDescription& scene) {
    PositionNumbers numbers(scene.positions.size());
    std::vector<std::uint32_t> places;  // [position], the same for equal ones
    places.reserve(scene.positions.size());
    for (const glm::vec3& position : scene.positions) places.push_back(numbers.number_of(Vec3f{position}));
    std::vector<Edge> edges;
    const std::uint32_t triangles = direct_triangles(scene);
    edges.reserve(3 * std::size_t{triangles});
    for (std::uint32_t t = 0; t < triangles; ++t) {
        const TriangleDescription& triangle = scene.triangles[t];
        if (!is_solid(scene, triangle.material)) continue;
        const std::array<std::uint32_t, 3> corner{places[triangle.vertex[0]], places[triangle.vertex[1]],
                                                  places[triangle.vertex[2]]};
        if (corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0]) continue;
        for (std::size_t i = 0; i < 3; ++i) {
            const auto [low, high] = std::minmax({corner[i], corner[(i + 1) % 3]});
            edges.push_back({low, high, t});
        }
    }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.ends() < b.ends(); });
    return edges;
}

/// Ray-triangle test in double. Comparisons with 0 only, so that it is independent of scale.   [Moeller and Trumbore
/// 1997]
bool crosses(glm::dvec3 origin, glm::dvec3 direction, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
    const glm::dvec3 p = glm::cross(direction, c - a);
    const double determinant = glm::dot(b - a, p);
    if (determinant == 0.0) return false;
    const glm::dvec3 s = origin - a;
    const double u = glm::dot(s, p) / determinant;
    const glm::dvec3 q = glm::cross(s, b - a);
    const double v = glm::dot(direction, q) / determinant;
    return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && glm::dot(c - a, q) / determinant > 0.0;
}

}  // namespace

Enclosure::Enclosure(const SceneDescription& scene) {
    const std::vector<Edge> edges = edges_of(scene);
    const std::uint32_t triangles = direct_triangles(scene);
    Connections connections(triangles);
    std::vector<std::uint32_t> at_border;
    for (std::size_t first = 0, end = 0; first < edges.size(); first = end) {
        while (end < edges.size() && edges[end].ends() == edges[first].ends())
            connections.join(edges[first].triangle, edges[end++].triangle);
        if ((end - first) % 2 != 0) at_border.push_back(edges[first].triangle);
    }
    std::vector<bool> is_open(triangles);
    for (const std::uint32_t triangle : at_border) is_open[connections.root(triangle)] = true;

    std::vector<std::pair<std::uint32_t, std::uint32_t>> closed;  // (surface, triangle)
    for (const Edge& edge : edges)
        if (const std::uint32_t root = connections.root(edge.triangle); !is_open[root])
            closed.emplace_back(root, edge.triangle);
    std::sort(closed.begin(), closed.end());
    closed.erase(std::unique(closed.begin(), closed.end()), closed.end());
    for (std::size_t i = 0; i < closed.size(); ++i) {
        const glm::uvec3 corner = scene.triangles[closed[i].second].vertex;
        const Face face{scene.positions[corner[0]], scene.positions[corner[1]], scene.positions[corner[2]]};
        if (i == 0 || closed[i - 1].first != closed[i].first) surfaces_.push_back({0, face.a, face.a});
        Surface& surface = surfaces_.back();
        surface.low = glm::min(glm::min(surface.low, face.a), glm::min(face.b, face.c));
        surface.high = glm::max(glm::max(surface.high, face.a), glm::max(face.b, face.c));
        faces_.push_back(face);
        surface.end = faces_.size();
    }
}

bool Enclosure::contains(glm::vec3 point) const {
    // Along no axis or diagonal, so that it meets no edges of typical scenes.
    constexpr glm::dvec3 kDirection{0.314159265358979, 0.577215664901533, 0.754877666246693};
    const glm::dvec3 origin{point};
    std::size_t first = 0;
    for (const Surface& surface : surfaces_) {
        const std::size_t begin = std::exchange(first, surface.end);
        const bool is_near =
            glm::all(glm::lessThanEqual(surface.low, origin)) && glm::all(glm::lessThanEqual(origin, surface.high));
        bool is_inside = false;
        for (std::size_t i = begin; is_near && i < surface.end; ++i)
            if (crosses(origin, kDirection, faces_[i].a, faces_[i].b, faces_[i].c)) is_inside = !is_inside;
        if (is_inside) return true;
    }
    return false;
}

}  // namespace pl
