// Directions from a point to a triangle: their solid angle, and directions uniform in it.
#pragma once

#include "core/kernel/base/angles.h"
#include "core/kernel/base/math.h"

namespace pl {

/// A triangle projected onto the unit sphere around a point: unit directions to its corners.
struct SphericalTriangle {
    Vec3f a, b, c;

    /// In steradians, in [0, 2 pi); NaN if a corner is at the point.
    /// [Van Oosterom and Strackee 1983, "The Solid Angle of a Plane Triangle", eq. 8]
    PL_HD float solid_angle() const {
        const float sine = std::fabs(glm::dot(a, glm::cross(b, c)));
        const float cosine = 1.0f + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a);
        return 4.0f * kPi * turns_of(sine, cosine);
    }

    /// The same triangle with its corners turned so that ac is the longest side.
    PL_HD SphericalTriangle with_longest_side_ac() const {
        const float ab = glm::dot(a, b);
        const float bc = glm::dot(b, c);
        const float ca = glm::dot(c, a);
        if (ab < bc && ab < ca) return {b, c, a};
        return bc < ca ? SphericalTriangle{c, a, b} : *this;
    }
};

/// The component of v at right angles to the unit vector `axis`, of unit length.
PL_HD inline Vec3f unit_across(Vec3f v, Vec3f axis) { return glm::normalize(v - glm::dot(v, axis) * axis); }

/// Maps [0,1)^2 to directions uniform in a spherical triangle of this solid angle: u.x cuts off its share of the area by an
/// arc from b to a point of the side ac, the longest one, because arcs to a point opposite of b have no direction; u.y is a point of
/// that arc. Not for triangles that are nearly empty or a hemisphere.
/// [Arvo 1995, "Stratified Sampling of Spherical Triangles"; Pharr, Jakob, Humphreys, Physically Based Rendering, 4th ed., 6.5.4]
PL_HD inline Vec3f square_to_spherical_triangle(const SphericalTriangle& triangle, float solid_angle, Vec2f u) {
    const SphericalTriangle t = triangle.with_longest_side_ac();
    // The angle at a, between the planes of ab and ac.
    const Vec3f normal_ab = glm::normalize(glm::cross(t.a, t.b));
    const Vec3f normal_ac = glm::normalize(glm::cross(t.a, t.c));
    const float cos_a = glm::dot(normal_ab, normal_ac);
    const float sin_a = glm::length(glm::cross(normal_ab, normal_ac));
    // phi: the angles of the part at b and on ac together, pi + area of the part - angle at a.
    const SineCosine part = sine_cosine_of_positive_turns(u.x * solid_angle * (0.5f * kInvPi));
    const float sin_phi = part.cosine * sin_a - part.sine * cos_a;
    const float cos_phi = -part.cosine * cos_a - part.sine * sin_a;
    const float p = cos_phi + cos_a;
    const float q = sin_phi - sin_a * glm::dot(t.a, t.b);
    const float numerator = q + (q * cos_phi - p * sin_phi) * cos_a;
    const float denominator = (q * sin_phi + p * cos_phi) * sin_a;
    const float cos_along = denominator != 0.0f ? clamp_to(numerator / denominator, -1.0f, 1.0f) : 1.0f;
    const float sin_along = std::sqrt(1.0f - cos_along * cos_along);
    const Vec3f on_ac = cos_along * t.a + sin_along * unit_across(t.c, t.a);
    const float cos_b = 1.0f - u.y * (1.0f - glm::dot(on_ac, t.b));
    const float sin_b = std::sqrt(max_of(1.0f - cos_b * cos_b, 0.0f));
    return cos_b * t.b + sin_b * unit_across(on_ac, t.b);
}

}  // namespace pl
