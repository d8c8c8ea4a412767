#include "core/scene/up_axis.h"

#include <algorithm>
#include <cmath>

#include "core/scene/instance_boxes.h"
#include "core/scene/instances.h"
#include "core/scene/pack_scene.h"

namespace pl {
namespace {

/// Areas of all direct triangles, and of boxes around instances, projected along x, y and z.
glm::dvec3 projected_areas(const SceneDescription& scene) {
    glm::dvec3 sum(0.0);
    const auto add = [&](const std::array<glm::dvec3, 3>& p) {
        sum += 0.5 * glm::abs(glm::cross(p[1] - p[0], p[2] - p[0]));
    };
    for (std::uint32_t i = 0; i < direct_triangles(scene); ++i) {
        const glm::uvec3& vertex = scene.triangles[i].vertex;
        add({glm::dvec3(scene.positions[vertex.x]), glm::dvec3(scene.positions[vertex.y]),
             glm::dvec3(scene.positions[vertex.z])});
    }
    const std::vector<Bounds> boxes = mesh_boxes(scene);
    for (const InstanceDescription& instance : scene.instances)
        for_box_triangles(box_corners(boxes[instance.mesh], instance.to_world), add);
    return sum;
}

bool stands_on_zero(const Bounds& bounds, int axis) {
    constexpr double kTouching = 0.05;
    constexpr double kMiddle = 0.25;
    const glm::dvec3 low(bounds.low);
    const glm::dvec3 extent = glm::dvec3(bounds.high) - low;
    if (std::abs(low[axis]) > kTouching * extent[axis]) return false;
    for (const int other : {(axis + 1) % 3, (axis + 2) % 3})
        if (std::abs(low[other] + 0.5 * extent[other]) > kMiddle * extent[other]) return false;
    return true;
}

}  // namespace

glm::vec3 guess_up(const SceneDescription& scene) {
    constexpr glm::vec3 kY{0.0f, 1.0f, 0.0f};
    constexpr glm::vec3 kZ{0.0f, 0.0f, 1.0f};
    const Bounds bounds = bounds_of(scene);
    if (stands_on_zero(bounds, 1)) return kY;
    if (stands_on_zero(bounds, 2)) return kZ;
    const glm::dvec3 area = projected_areas(scene);
    return area.z >= 2.0 * std::max(area.x, area.y) ? kZ : kY;
}

glm::vec3 up_direction(UpAxis axis, const SceneDescription& scene) {
    switch (axis) {
    case UpAxis::Auto: return guess_up(scene);
    case UpAxis::X: return {1.0f, 0.0f, 0.0f};
    case UpAxis::Y: return {0.0f, 1.0f, 0.0f};
    case UpAxis::Z: return {0.0f, 0.0f, 1.0f};
    }
    return {0.0f, 1.0f, 0.0f};
}

glm::vec3 nearest_axis(const glm::vec3& direction) {
    const glm::vec3 size = glm::abs(direction);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    glm::vec3 nearest(0.0f);
    nearest[axis] = direction[axis] < 0.0f ? -1.0f : 1.0f;
    return nearest;
}

glm::vec3 front_of(const glm::vec3& up) {
    if (up.z != 0.0f) return {0.0f, -up.z, 0.0f};
    return {0.0f, 0.0f, up.x + up.y};
}

}  // namespace pl
