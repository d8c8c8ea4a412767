// Rays and hits.
#pragma once

#include <cstdint>

#include "core/kernel/base/math.h"

namespace pl {

/// No primitive: the source of camera rays, and the primitive of a miss.
inline constexpr std::uint32_t kNoPrimitive = 0xffffffffu;

/// The points origin + t * direction with 0 < t <= t_max. The direction need not be unit.
struct Ray {
    Vec3f origin{0.0f};
    Vec3f direction{0.0f, 0.0f, 1.0f};
    float t_max = kInfinity;
    /// A ray cannot hit the planar triangle that it starts on, so the source (and the target of a shadow ray) are
    /// excluded by number; a minimal distance would depend on the scale of the scene.
    std::uint32_t source = kNoPrimitive;
    std::uint32_t target = kNoPrimitive;
};

/// Closest hit: t in units of the ray direction's length, and barycentric weights.
struct Hit {
    float t = kInfinity;
    std::uint32_t primitive = kNoPrimitive;
    float b1 = 0.0f, b2 = 0.0f;  ///< weights of corners 1 and 2; b0 = 1 - b1 - b2

    PL_HD bool found() const { return primitive != kNoPrimitive; }
};

}  // namespace pl
