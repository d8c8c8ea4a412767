// Parallax: one table serves all points around its volume, and each of them receives the same light from another
// direction. All incident radiance is assumed to come from a sphere around the volume's site: a direction at a point
// maps to the direction from the site to the intersection of the point's ray with that sphere. The map is a bijection
// for every point inside, so densities stay exact for any radius; a wrong radius costs variance, not bias.
// [after Ruppert et al. 2020, "Robust Fitting of Parallax-Aware Mixtures for Path Guiding"]
#pragma once

#include "core/kernel/base/numbers.h"

namespace pl {

/// Largest distance of a point from the site, as a share of the sphere's radius; points farther away are moved towards the
/// site. The Jacobian then stays between 0.01 and 3.7.
inline constexpr float kMostOffset = 0.9f;

/// A direction at the site, with the Jacobian of the map from the point.
template <class N>
struct SiteDirection {
    Real3<N> direction;
    typename N::Real jacobian;  ///< steradians at the site per steradian at the point
};

/// The map between directions at a point and at the site that serves it. The identity, bit for bit, for an infinite radius
/// (an inverse of 0).
template <class N>
class Parallax {
public:
    /// `inverse_reach` is one over the radius of the sphere around the site.
    PL_INLINE Parallax(const Real3<N>& site, const Real3<N>& point, typename N::Real inverse_reach) {
        const auto x = (point.x - site.x) * inverse_reach;
        const auto y = (point.y - site.y) * inverse_reach;
        const auto z = (point.z - site.z) * inverse_reach;
        const auto length = N::sqrt(x * x + y * y + z * z);
        const auto scale = select(length > kMostOffset, kMostOffset / length, N::constant(1.0f));
        offset_ = {x * scale, y * scale, z * scale};
    }

    /// From a unit direction at the site to the unit direction at the point.
    PL_INLINE Real3<N> to_point(const Real3<N>& direction) const {
        const auto x = direction.x - offset_.x;
        const auto y = direction.y - offset_.y;
        const auto z = direction.z - offset_.z;
        const auto inverse_length = 1.0f / N::sqrt(x * x + y * y + z * z);
        return {x * inverse_length, y * inverse_length, z * inverse_length};
    }

    /// From a unit direction at the point to the site. With t the distance to the unit sphere along wi, an area dA on the
    /// sphere subtends dw = dA cos / t^2 at the point and dw' = dA at the site, so dw' / dw = t^2 / cos.
    PL_INLINE SiteDirection<N> to_site(const Real3<N>& wi) const {
        const auto along = dot(offset_, wi);
        const auto cosine =
            N::sqrt(along * along + (1.0f - dot(offset_, offset_)));  // of wi with the sphere's normal
        const auto t = cosine - along;
        return {{offset_.x + t * wi.x, offset_.y + t * wi.y, offset_.z + t * wi.z}, t * t / cosine};
    }

private:
    Real3<N> offset_;  ///< of the point from the site, in units of the radius
};

}  // namespace pl
