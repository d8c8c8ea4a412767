// An orthonormal frame around a unit normal: local z is the normal.
#pragma once

#include "core/kernel/base/math.h"

namespace pl {

struct Frame {
    Vec3f x, y, z;

    PL_HD Vec3f to_world(Vec3f local) const { return local.x * x + local.y * y + local.z * z; }
    PL_HD Vec3f to_local(Vec3f world) const { return {glm::dot(world, x), glm::dot(world, y), glm::dot(world, z)}; }
};

/// Branchless and continuous except at z = -0.   [Duff et al. 2017, "Building an Orthonormal Basis, Revisited"]
PL_HD inline Frame make_frame(Vec3f normal) {
    const float sign = std::copysign(1.0f, normal.z);
    const float a = -1.0f / (sign + normal.z);
    const float b = normal.x * normal.y * a;
    return {{1.0f + sign * normal.x * normal.x * a, sign * b, -sign * normal.x},
            {b, sign + normal.y * normal.y * a, -normal.y},
            normal};
}

}  // namespace pl
