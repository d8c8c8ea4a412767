// Axis-aligned boxes.
#pragma once

#include "core/kernel/base/math.h"

namespace pl {

/// Axis-aligned bounds of points; low > high without any.
struct Bounds {
    Vec3f low{kInfinity};
    Vec3f high{-kInfinity};

    void add(Vec3f point) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    bool empty() const { return !(low.x <= high.x); }
    Vec3f center() const { return 0.5f * (low + high); }
    float diagonal() const { return empty() ? 0.0f : glm::length(high - low); }
};

}  // namespace pl
