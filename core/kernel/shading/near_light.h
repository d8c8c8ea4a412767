// Emissive triangles near a surface, which are sampled uniformly in solid angle. Uniform over their area, samples near the surface
// would be too rare there: their weight cos / distance^2 has no bound.
#pragma once

#include "core/kernel/base/spherical_triangle.h"
#include "core/kernel/base/warp.h"
#include "core/kernel/scene/surface_point.h"

namespace pl {

/// A triangle is near if the square of the distance to its centroid is below its area times this. Compact ones beyond it fill less than
/// 1/kNearDistance steradians, in which area sampling is even enough and costs less; slivers are left to it, too.
inline constexpr float kNearDistance = 2.0f;
/// Solid angles that are sampled: directions within a smaller one, or one that fills a hemisphere, are not exact enough.
inline constexpr float kLeastSolidAngle = 1e-2f;
inline constexpr float kMostSolidAngle = 6.2f;

/// A triangle seen from a point.
template <class N>
struct SeenTriangleOf {
    CornersOf<N> corners;  ///< relative to the point
    typename N::Real area;

    PL_INLINE typename N::Mask is_near() const {
        const Real3<N> centroid = scaled(corners.p0 + corners.p1 + corners.p2, N::constant(1.0f / 3.0f));
        return dot(centroid, centroid) < kNearDistance * area;
    }
};
template <class N>
PL_INLINE SeenTriangleOf<N> see_triangle(const CornersOf<N>& triangle, const Real3<N>& from) {
    const CornersOf<N> corners = triangle.relative_to(from);
    const Real3<N> normal = corners.normal();
    return {corners, 0.5f * N::sqrt(dot(normal, normal))};
}

using SeenTriangle = SeenTriangleOf<One>;

template <class N>
PL_INLINE SphericalTriangleOf<N> directions_of(const SeenTriangleOf<N>& seen) {
    return {normalized(seen.corners.p0), normalized(seen.corners.p1), normalized(seen.corners.p2)};
}

PL_HD inline SeenTriangle see_triangle(const SceneView& scene, std::uint32_t primitive, Vec3f from) {
    return see_triangle(corners_of(scene, scene.triangles[primitive]), unpack(from));
}

/// Solid angle of a triangle that is sampled by solid angle; 0 of others.
template <class N>
PL_INLINE typename N::Real near_solid_angle(const SeenTriangleOf<N>& seen) {
    const typename N::Mask is_near = seen.is_near();
    if (!N::any(is_near)) return N::constant(0.0f);
    const typename N::Real solid_angle = directions_of(seen).solid_angle();
    const typename N::Mask is_exact = (solid_angle > kLeastSolidAngle) & (solid_angle < kMostSolidAngle);
    return select(static_cast<typename N::Mask>(is_near & is_exact), solid_angle, N::constant(0.0f));
}

/// Barycentric weights of the triangle's point in a direction through it, kept inside against rounding.
template <class N>
PL_INLINE Real3<N> weights_towards(const SeenTriangleOf<N>& seen, const Real3<N>& direction) {
    const CornersOf<N>& corners = seen.corners;
    const Real3<N> w{dot(direction, cross(corners.p1, corners.p2)), dot(direction, cross(corners.p2, corners.p0)),
                     dot(direction, cross(corners.p0, corners.p1))};
    const typename N::Real sign =
        select(static_cast<typename N::Mask>(w.x + w.y + w.z < 0.0f), N::constant(-1.0f), N::constant(1.0f));
    const Real3<N> weights{max_real<N>(sign * w.x, 0.0f), max_real<N>(sign * w.y, 0.0f),
                           max_real<N>(sign * w.z, 0.0f)};
    return scaled(weights, 1.0f / (weights.x + weights.y + weights.z));
}

/// Barycentric weights of a uniform point of a triangle; u in [0,1)^2.
template <class N>
PL_INLINE Real3<N> sample_weights(const Real2<N>& u) {
    const Real2<N> b = square_to_triangle(u);
    return {1.0f - b.x - b.y, b.x, b.y};
}
PL_HD inline Vec3f sample_weights(Vec2f u) { return pack(sample_weights(unpack(u))); }

/// A sampled point of a triangle.
template <class N>
struct TriangleSample {
    Real3<N> weights;                     ///< barycentric
    typename N::Real area_per_steradian;  ///< 0 unless it is sampled by solid angle
};

/// A point of a triangle: uniform in solid angle if it is near, else over its area; u in [0,1)^2.
template <class N>
PL_INLINE TriangleSample<N> sample_triangle(const SeenTriangleOf<N>& seen, const Real2<N>& u) {
    const Real3<N> over_area = sample_weights(u);
    const typename N::Real solid_angle = near_solid_angle(seen);
    const typename N::Mask is_near = solid_angle > 0.0f;
    if (!N::any(is_near)) return {over_area, N::constant(0.0f)};
    const Real3<N> direction = square_to_spherical_triangle(directions_of(seen), solid_angle, u);
    return {select(is_near, weights_towards(seen, direction), over_area),
            select(is_near, seen.area / solid_angle, N::constant(0.0f))};
}

}  // namespace pl
