// One table serves all points around its volume, and from each of them the same light is seen in another direction. As
// if all light came from a sphere around the site, a direction at a point stands for the direction from the site to
// where its ray leaves that sphere. A bijection for every point inside, so densities stay exact whatever the radius is:
// a wrong one costs noise.   [the idea: Ruppert et al. 2020, "Robust Fitting of Parallax-Aware Mixtures for Path Guiding"]
#pragma once

#include "core/kernel/base/numbers.h"

namespace pl {

/// A point further from the site counts as if it were this far, as a share of the sphere's radius: solid angles then
/// change by a factor between 0.01 and 3.7.
inline constexpr float kMostOffset = 0.9f;

/// A direction at the site, and how many steradians there one steradian at the point makes.
template <class N>
struct SiteDirection {
    Real3<N> direction;
    typename N::Real steradians;
};

/// Where a point stands relative to the site that serves it. With an infinite radius, an inverse of 0, both see the
/// same, bit by bit.
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

    /// What the site sees at `direction`, as the point sees it. Unit in, unit out.
    PL_INLINE Real3<N> to_point(const Real3<N>& direction) const {
        const auto x = direction.x - offset_.x;
        const auto y = direction.y - offset_.y;
        const auto z = direction.z - offset_.z;
        const auto inverse_length = 1.0f / N::sqrt(x * x + y * y + z * z);
        return {x * inverse_length, y * inverse_length, z * inverse_length};
    }

    /// The other way. With t the way to the unit sphere, an area dA on it is t^2 dw / cos from here and dw' from its center.
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
