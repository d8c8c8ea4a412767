#include "core/scene/far_origin.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/scene/pack_scene.h"

namespace pl {

glm::dvec3 far_origin(const glm::dvec3& low, const glm::dvec3& high) {
    constexpr double kFloatStep = 0x1p-23;
    const glm::dvec3 sides = high - low;
    const double extent = std::max({sides.x, sides.y, sides.z});
    glm::dvec3 origin(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        const double middle = 0.5 * low[axis] + 0.5 * high[axis];
        if (!(std::abs(middle) > kFarAway * extent)) continue;
        // The bounds may be bounds of floats, which show no extent below their step.
        const double unit = std::exp2(std::floor(std::log2(std::max(extent, kFloatStep * std::abs(middle)))));
        origin[axis] = std::round(middle / unit) * unit;
    }
    return origin;
}

glm::dvec3 far_origin(const SceneDescription& scene) {
    Bounds bounds = bounds_of(scene);
    if (bounds.empty())
        for (const glm::vec3& position : scene.positions) bounds.add(position);
    return bounds.empty() ? glm::dvec3(0.0) : far_origin(glm::dvec3(bounds.low), glm::dvec3(bounds.high));
}

void tell_origin(SceneDescription& scene) {
    if (scene.origin == glm::dvec3(0.0)) return;
    scene.warnings.push_back(fmt::format(
        "{}: far from the origin, moved by {} {} {} to keep its shape in floats; a scene file's points are in "
        "coordinates of the mesh file, those of --eye, --target and camera files in moved ones",
        scene.source.string(), 0.0 - scene.origin.x, 0.0 - scene.origin.y, 0.0 - scene.origin.z));
}

}  // namespace pl
