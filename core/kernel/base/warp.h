// Maps between the unit square and the shapes that are sampled, each with its density and its inverse.
#pragma once

#include "core/kernel/base/math.h"

namespace pl {

/// Concentric map of [0,1]^2 to the unit disk; equal areas map to equal areas.   [Shirley and Chiu 1997]
PL_HD inline Vec2f square_to_disk(Vec2f u) {
    const float a = 2.0f * u.x - 1.0f;
    const float b = 2.0f * u.y - 1.0f;
    if (a == 0.0f && b == 0.0f) return {0.0f, 0.0f};
    if (std::fabs(a) > std::fabs(b)) {
        const float angle = kPiOver4 * (b / a);
        return {a * cos_quarter(angle), a * sin_quarter(angle)};
    }
    const float angle = kPiOver4 * (a / b);
    return {b * sin_quarter(angle), b * cos_quarter(angle)};
}

/// Inverse of square_to_disk: a point of the unit disk to [0,1]^2.
PL_HD inline Vec2f disk_to_square(Vec2f p) {
    const float radius = std::sqrt(p.x * p.x + p.y * p.y);
    if (radius == 0.0f) return {0.5f, 0.5f};
    float a, b;
    if (std::fabs(p.x) > std::fabs(p.y)) {
        a = std::copysign(radius, p.x);
        b = a * (atan_unit(p.y / p.x) / kPiOver4);
    } else {
        b = std::copysign(radius, p.y);
        a = b * (atan_unit(p.x / p.y) / kPiOver4);
    }
    return {clamp_to(0.5f * (a + 1.0f), 0.0f, 1.0f), clamp_to(0.5f * (b + 1.0f), 0.0f, 1.0f)};
}

/// Lifts [0,1]^2 to the hemisphere around +z. Uniform input gives density cos(theta)/pi per steradian.
/// [Malley's method; Pharr, Jakob, Humphreys, Physically Based Rendering, 4th ed., A.5.3]
PL_HD inline Vec3f square_to_cosine_hemisphere(Vec2f u) {
    const Vec2f d = square_to_disk(u);
    return {d.x, d.y, safe_sqrt(1.0f - d.x * d.x - d.y * d.y)};
}

/// Inverse of square_to_cosine_hemisphere for unit directions with z >= 0.
PL_HD inline Vec2f cosine_hemisphere_to_square(Vec3f direction) { return disk_to_square({direction.x, direction.y}); }

/// Density of cosine-weighted directions, per steradian; 0 below the horizon.
PL_HD inline float cosine_hemisphere_pdf_sa(float cos_theta) { return cos_theta > 0.0f ? cos_theta * kInvPi : 0.0f; }

/// Barycentric coordinates (b1, b2), uniform over a triangle's area.   [Heitz 2019, "A Low-Distortion Map"]
PL_HD inline Vec2f square_to_triangle(Vec2f u) {
    if (u.y > u.x) {
        const float b1 = 0.5f * u.x;
        return {b1, u.y - b1};
    }
    const float b2 = 0.5f * u.y;
    return {u.x - b2, b2};
}

}  // namespace pl
