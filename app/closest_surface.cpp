#include "app/closest_surface.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "core/scene/instance_boxes.h"
#include "core/scene/instances.h"

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

/// The closest of the surfaces that it is given.
class ClosestSearch {
public:
    explicit ClosestSearch(const glm::dvec3& point) : point_(point) {}

    double distance() const { return best_; }
    const ClosestSurface& result() const { return result_; }

    void add(const Corners& corners) {
        const glm::dvec3 normal = glm::normalize(glm::cross(corners.b - corners.a, corners.c - corners.a));
        const glm::dvec3 q = closest_on_triangle(point_, corners, normal);
        if (const double distance = glm::distance(point_, q); distance < best_) {
            best_ = distance;
            const double side = glm::dot(point_ - corners.a, normal) < 0.0 ? -1.0 : 1.0;
            result_ = {.position = q, .normal = side * normal, .distance = static_cast<float>(distance)};
        }
    }

private:
    glm::dvec3 point_;
    double best_ = std::numeric_limits<double>::infinity();
    ClosestSurface result_{};
};

/// The corners of a triangle in the space of its mesh, or of the world.
Corners corners_of(const SceneDescription& scene, std::uint32_t triangle) {
    const glm::uvec3& vertex = scene.triangles[triangle].vertex;
    return {glm::dvec3(scene.positions[vertex.x]), glm::dvec3(scene.positions[vertex.y]),
            glm::dvec3(scene.positions[vertex.z])};
}

/// Distance from the bounds of these corners: at most that from the instance inside.
double distance_from_box(const glm::dvec3& p, const std::array<glm::dvec3, 8>& corners) {
    glm::dvec3 low = corners[0];
    glm::dvec3 high = corners[0];
    for (const glm::dvec3& corner : corners) {
        low = glm::min(low, corner);
        high = glm::max(high, corner);
    }
    return glm::length(glm::max(glm::dvec3(0.0), glm::max(low - p, p - high)));
}

/// Instances with their distances at least, the nearest first.
std::vector<std::pair<double, std::uint32_t>> nearest_instances(const SceneDescription& scene, const glm::dvec3& p) {
    const std::vector<Bounds> boxes = mesh_boxes(scene);
    std::vector<std::pair<double, std::uint32_t>> order;
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const InstanceDescription& instance = scene.instances[i];
        order.emplace_back(distance_from_box(p, box_corners(boxes[instance.mesh], instance.to_world)), i);
    }
    std::sort(order.begin(), order.end());
    return order;
}

}  // namespace

ClosestSurface closest_surface(const SceneDescription& scene, const glm::vec3& point) {
    const glm::dvec3 p(point);
    ClosestSearch search(p);
    for (std::uint32_t i = 0; i < direct_triangles(scene); ++i) search.add(corners_of(scene, i));
    for (const auto& [distance, number] : nearest_instances(scene, p)) {
        if (distance > search.distance()) break;
        const InstanceDescription& instance = scene.instances[number];
        const MeshDescription& mesh = scene.meshes[instance.mesh];
        const glm::dmat4x3 to_world(instance.to_world);
        const auto placed = [&](const glm::dvec3& q) { return to_world * glm::dvec4(q, 1.0); };
        for (std::uint32_t i = 0; i < mesh.triangle_count; ++i) {
            const Corners corners = corners_of(scene, mesh.first_triangle + i);
            search.add({placed(corners.a), placed(corners.b), placed(corners.c)});
        }
    }
    return search.result();
}

}  // namespace pl
