#include "app/closest_surface.h"

#include <algorithm>
#include <limits>

namespace pl {
namespace {

struct Corners {
    glm::dvec3 a, b, c;
};

glm::dvec3 closest_on_segment(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 ab = b - a;
    const double length2 = glm::dot(ab, ab);
    const double t = length2 > 0.0 ? std::clamp(glm::dot(p - a, ab) / length2, 0.0, 1.0) : 0.0;
    return a + t * ab;
}

/// The perpendicular foot if it falls inside, else the closest point of the three edges.
glm::dvec3 closest_on_triangle(const glm::dvec3& p, const Corners& t, const glm::dvec3& normal) {
    const glm::dvec3 foot = p - glm::dot(p - t.a, normal) * normal;
    const auto inside = [&](const glm::dvec3& from, const glm::dvec3& to) {
        return glm::dot(glm::cross(to - from, foot - from), normal) >= 0.0;
    };
    if (inside(t.a, t.b) && inside(t.b, t.c) && inside(t.c, t.a)) return foot;
    const glm::dvec3 candidates[] = {closest_on_segment(p, t.a, t.b), closest_on_segment(p, t.b, t.c),
                                     closest_on_segment(p, t.c, t.a)};
    return *std::min_element(std::begin(candidates), std::end(candidates),
                             [&](const auto& x, const auto& y) { return glm::distance(p, x) < glm::distance(p, y); });
}

}  // namespace

ClosestSurface closest_surface(const SceneDescription& scene, const glm::vec3& point) {
    const glm::dvec3 p(point);
    double best = std::numeric_limits<double>::infinity();
    ClosestSurface result;
    for (const TriangleDescription& triangle : scene.triangles) {
        const Corners corners{glm::dvec3(scene.positions[triangle.vertex.x]),
                              glm::dvec3(scene.positions[triangle.vertex.y]),
                              glm::dvec3(scene.positions[triangle.vertex.z])};
        const glm::dvec3 normal = glm::normalize(glm::cross(corners.b - corners.a, corners.c - corners.a));
        const glm::dvec3 q = closest_on_triangle(p, corners, normal);
        if (const double distance = glm::distance(p, q); distance < best) {
            best = distance;
            const double side = glm::dot(p - corners.a, normal) < 0.0 ? -1.0 : 1.0;
            result = {.position = q, .normal = side * normal, .distance = static_cast<float>(distance)};
        }
    }
    return result;
}

}  // namespace pl
