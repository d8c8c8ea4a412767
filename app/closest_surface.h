// The surface point closest to any point in space.
#pragma once

#include "core/scene/description.h"

namespace pl {

struct ClosestSurface {
    glm::vec3 position{0.0f};
    glm::vec3 normal{0.0f, 0.0f,
                     1.0f};  ///< unit, on the side of the point; on the front if the point lies in the plane
    float distance = 0.0f;
};

/// Tests every direct triangle of a valid scene, and the triangles of the instances whose boxes are nearer than all
/// surfaces found before.
ClosestSurface closest_surface(const SceneDescription& scene, const glm::vec3& point);

}  // namespace pl
