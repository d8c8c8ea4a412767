// Sampling warps from the unit square, with their densities and inverses.
#pragma once

#include "core/kernel/base/numbers.h"

namespace pl {

/// Concentric map of [0,1]^2 to the unit disk, area preserving: density 1/pi.   [Shirley and Chiu 1997, "A Low
/// Distortion Map Between Disk and Square"]
template <class N>
PL_INLINE Real2<N> square_to_disk(const Real2<N>& u) {
    const auto a = 2.0f * u.x - 1.0f;
    const auto b = 2.0f * u.y - 1.0f;
    const auto zero = N::constant(0.0f);
    const typename N::Mask wide = N::magnitude(a) > N::magnitude(b);
    const auto radius = select(wide, a, b);
    const auto angle = kPiOver4 * (select(wide, b, a) / radius);
    const auto near = radius * cos_quarter<N>(angle);
    const auto far = radius * sin_quarter<N>(angle);
    const typename N::Mask center = radius == 0.0f;
    return {select(center, zero, select(wide, near, far)), select(center, zero, select(wide, far, near))};
}
PL_HD inline Vec2f square_to_disk(Vec2f u) { return pack(square_to_disk(unpack(u))); }

/// Inverse of square_to_disk: a point of the unit disk to [0,1]^2.
template <class N>
PL_INLINE Real2<N> disk_to_square(const Real2<N>& p) {
    const auto radius = N::sqrt(p.x * p.x + p.y * p.y);
    const typename N::Mask wide = N::magnitude(p.x) > N::magnitude(p.y);
    const auto large = select(wide, p.x, p.y);
    const auto small = select(wide, p.y, p.x);
    const auto along = N::copy_sign(radius, large);
    const auto across = along * (atan_unit<N>(small / large) / kPiOver4);
    const auto half = N::constant(0.5f);
    const typename N::Mask center = radius == 0.0f;
    return {select(center, half, clamp_real<N>(0.5f * (select(wide, along, across) + 1.0f), 0.0f, 1.0f)),
            select(center, half, clamp_real<N>(0.5f * (select(wide, across, along) + 1.0f), 0.0f, 1.0f))};
}
PL_HD inline Vec2f disk_to_square(Vec2f p) { return pack(disk_to_square(unpack(p))); }

/// Malley's method: [0,1]^2 to the hemisphere around +z with density cos(theta)/pi per steradian.   [Pharr, Jakob,
/// Humphreys, Physically Based Rendering, 4th ed., A.5.3]
template <class N>
PL_INLINE Real3<N> square_to_cosine_hemisphere(const Real2<N>& u) {
    const Real2<N> d = square_to_disk(u);
    const auto z2 = 1.0f - d.x * d.x - d.y * d.y;
    return {d.x, d.y, N::sqrt(select(z2 < 0.0f, N::constant(0.0f), z2))};
}
PL_HD inline Vec3f square_to_cosine_hemisphere(Vec2f u) { return pack(square_to_cosine_hemisphere(unpack(u))); }

/// Inverse of square_to_cosine_hemisphere for unit directions with z >= 0.
PL_HD inline Vec2f cosine_hemisphere_to_square(Vec3f direction) { return disk_to_square({direction.x, direction.y}); }

/// Density of square_to_cosine_hemisphere() per steradian; 0 below the horizon.
template <class N>
PL_INLINE typename N::Real cosine_pdf_sa(typename N::Real cos_theta) {
    return select(cos_theta > 0.0f, cos_theta * kInvPi, N::constant(0.0f));
}
PL_HD inline float cosine_hemisphere_pdf_sa(float cos_theta) { return cosine_pdf_sa<One>(cos_theta); }

/// Barycentric coordinates (b1, b2), uniform over a triangle's area.   [Heitz 2019, "A Low-Distortion Map Between
/// Triangle and Square"]
template <class N>
PL_INLINE Real2<N> square_to_triangle(const Real2<N>& u) {
    const typename N::Mask upper = u.y > u.x;
    const auto half = 0.5f * select(upper, u.x, u.y);
    return select(upper, Real2<N>{half, u.y - half}, Real2<N>{u.x - half, half});
}
PL_HD inline Vec2f square_to_triangle(Vec2f u) { return pack(square_to_triangle(unpack(u))); }

/// Binary search: the first of `count` indices at which `holds` is true, `count` if there is none. `holds` must be
/// monotone (false, then true).
template <class Predicate>
PL_HD inline std::uint32_t find_first(std::uint32_t count, Predicate holds) {
    std::uint32_t low = 0;
    std::uint32_t high = count;
    while (low < high) {
        const std::uint32_t middle = (low + high) / 2;
        if (holds(middle))
            high = middle;
        else
            low = middle + 1;
    }
    return low;
}

/// Inversion of a discrete distribution: the index of the interval that contains u in [0,1), among `count` > 0
/// intervals with upper ends cumulative(index), which ascend to 1.
template <class Cumulative>
PL_HD inline std::uint32_t find_interval(std::uint32_t count, float u, Cumulative cumulative) {
    return find_first(count - 1, [&](std::uint32_t index) { return u < cumulative(index); });
}

/// Sample of the tent 1 - |x| on [-1, 1] from a uniform number.
template <class N>
PL_INLINE typename N::Real sample_tent(typename N::Real u) {
    const typename N::Mask low = u < 0.5f;
    const auto root = N::sqrt(2.0f * select(low, u, 1.0f - u));
    return select(low, root - 1.0f, 1.0f - root);
}

/// Reflects a coordinate in (-1, side + 1) at the ends of [0, side] and keeps it below `side`.
template <class N>
PL_INLINE typename N::Real reflect_into(typename N::Real x, float side) {
    const auto folded = select(x < 0.0f, -x, select(x > side, 2.0f * side - x, x));
    return clamp_real<N>(folded, 0.0f, side);
}

}  // namespace pl
