// Directions from a point to a triangle: their solid angle, and directions uniform in it. Templates over the number type, see numbers.h.
#pragma once

#include "core/kernel/base/angles.h"

namespace pl {

/// A triangle projected onto the unit sphere around a point: unit directions to its corners.
template <class N>
struct SphericalTriangleOf {
    Real3<N> a, b, c;

    /// In steradians, in [0, 2 pi); NaN if a corner is at the point.
    /// [Van Oosterom and Strackee 1983, "The Solid Angle of a Plane Triangle", eq. 8]
    PL_INLINE typename N::Real solid_angle() const {
        const typename N::Real sine = N::magnitude(dot(a, cross(b, c)));
        const typename N::Real cosine = 1.0f + dot(a, b) + dot(b, c) + dot(c, a);
        return 4.0f * kPi * turns_of<N>(sine, cosine);
    }

    /// This triangle with its corners renamed so that ac is the longest side.
    PL_INLINE SphericalTriangleOf with_longest_side_ac() const {
        const typename N::Real ab = dot(a, b);
        const typename N::Real bc = dot(b, c);
        const typename N::Real ca = dot(c, a);
        const typename N::Mask ab_is_longest = (ab < bc) & (ab < ca);
        const typename N::Mask bc_is_longer = bc < ca;
        const auto turned = [&](const Real3<N>& if_ab, const Real3<N>& if_bc, const Real3<N>& if_ca) {
            return select(ab_is_longest, if_ab, select(bc_is_longer, if_bc, if_ca));
        };
        return {turned(b, c, a), turned(c, a, b), turned(a, b, c)};
    }
};

using SphericalTriangle = SphericalTriangleOf<One>;

/// The component of v at right angles to the unit vector `axis`, of unit length.
template <class N>
PL_INLINE Real3<N> unit_across(const Real3<N>& v, const Real3<N>& axis) {
    return normalized(v - scaled(axis, dot(v, axis)));
}

/// Maps [0,1)^2 to directions uniform in a spherical triangle of this solid angle: u.x cuts off its share of the area by an
/// arc from b to a point of the side ac, the longest one, because arcs to a point opposite of b have no direction; u.y is a point of
/// that arc. Not for triangles that are nearly empty or a hemisphere.
/// [Arvo 1995, "Stratified Sampling of Spherical Triangles"; Pharr, Jakob, Humphreys, Physically Based Rendering, 4th ed., 6.5.4]
template <class N>
PL_INLINE Real3<N> square_to_spherical_triangle(const SphericalTriangleOf<N>& triangle,
                                                const typename N::Real& solid_angle, const Real2<N>& u) {
    using Real = typename N::Real;
    const SphericalTriangleOf<N> t = triangle.with_longest_side_ac();
    // The angle at a, between the planes of ab and ac.
    const Real3<N> normal_ab = normalized(cross(t.a, t.b));
    const Real3<N> normal_ac = normalized(cross(t.a, t.c));
    const Real cos_a = dot(normal_ab, normal_ac);
    const Real3<N> turn = cross(normal_ab, normal_ac);
    const Real sin_a = N::sqrt(dot(turn, turn));
    // phi: the angles of the part at b and on ac together, pi + area of the part - angle at a.
    const SineCosineOf<N> part = sine_cosine_of_positive_turns<N>(u.x * solid_angle * (0.5f * kInvPi));
    const Real sin_phi = part.cosine * sin_a - part.sine * cos_a;
    const Real cos_phi = -part.cosine * cos_a - part.sine * sin_a;
    const Real p = cos_phi + cos_a;
    const Real q = sin_phi - sin_a * dot(t.a, t.b);
    const Real numerator = q + (q * cos_phi - p * sin_phi) * cos_a;
    const Real denominator = (q * sin_phi + p * cos_phi) * sin_a;
    const Real cos_along = select(static_cast<typename N::Mask>(denominator != 0.0f),
                                  clamp_real<N>(numerator / denominator, -1.0f, 1.0f), N::constant(1.0f));
    const Real sin_along = N::sqrt(1.0f - cos_along * cos_along);
    const Real3<N> on_ac = scaled(t.a, cos_along) + scaled(unit_across(t.c, t.a), sin_along);
    const Real cos_b = 1.0f - u.y * (1.0f - dot(on_ac, t.b));
    const Real sin_b = N::sqrt(max_real<N>(1.0f - cos_b * cos_b, 0.0f));
    return scaled(t.b, cos_b) + scaled(unit_across(on_ac, t.b), sin_b);
}

}  // namespace pl
