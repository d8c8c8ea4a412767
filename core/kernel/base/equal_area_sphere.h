// The cylindrical map between the unit square and the sphere of directions, area preserving: density 1 / (4 pi) per steradian.
// x is (1 + z) / 2, y the azimuth in turns.   [Archimedes; Mueller et al. 2017, section 3.2]
#pragma once

#include "core/kernel/base/angles.h"
#include "core/kernel/base/math.h"

namespace pl {

/// Density of a uniform direction per steradian.
inline constexpr float kUniformSpherePdf = 0.25f * kInvPi;
/// Largest float below 1.
inline constexpr float kBelowOne = 0x1.fffffep-1f;

/// A point of [0,1)^2 to a unit direction.
PL_HD inline Vec3f square_to_sphere(Vec2f square) {
    const float radius = 2.0f * std::sqrt(max_of(square.x * (1.0f - square.x), 0.0f));
    const SineCosine turn = sine_cosine_of_positive_turns(square.y);
    return {radius * turn.cosine, radius * turn.sine, 2.0f * square.x - 1.0f};
}

/// The inverse, into [0,1)^2. The azimuth of the poles is 0.
PL_HD inline Vec2f sphere_to_square(Vec3f direction) {
    const float turns = turns_of(direction.y, direction.x);
    return {clamp_to(0.5f * (direction.z + 1.0f), 0.0f, kBelowOne),
            clamp_to(turns < 0.0f ? turns + 1.0f : turns, 0.0f, kBelowOne)};
}

}  // namespace pl
