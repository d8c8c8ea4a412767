// Rays and what they hit.
#pragma once

#include <cstdint>

#include "core/kernel/base/math.h"

namespace pl {

/// No primitive: the source of camera rays, the result of a miss.
inline constexpr std::uint32_t kNoPrimitive = 0xffffffffu;

/// A segment: points origin + t * direction with 0 < t <= t_max. The direction need not be unit.
struct Ray {
    Vec3f origin{0.0f};
    Vec3f direction{0.0f, 0.0f, 1.0f};
    float t_max = kInfinity;
    /// Planar triangles cannot be hit by rays that leave them, so the source (and a shadow ray's target)
    /// are excluded by number instead of by a distance that would have to guess the scale of the scene.
    std::uint32_t source = kNoPrimitive;
    std::uint32_t target = kNoPrimitive;
};

/// Closest hit: distance in units of the ray direction, barycentric weights of the triangle's three corners.
struct Hit {
    float t = kInfinity;
    std::uint32_t primitive = kNoPrimitive;
    float b1 = 0.0f, b2 = 0.0f;  ///< weights of corners 1 and 2; corner 0 has the rest

    PL_HD bool found() const { return primitive != kNoPrimitive; }
};

}  // namespace pl
