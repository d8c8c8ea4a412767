// Emissive triangles near a surface, which are sampled uniformly in solid angle. Uniform over their area, samples near the surface
// would be too rare there: their weight cos / distance^2 has no bound.
#pragma once

#include "core/kernel/base/spherical_triangle.h"
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

PL_HD inline SphericalTriangle directions_of(const SeenTriangle& seen) {
    return {glm::normalize(pack(seen.corners.p0)), glm::normalize(pack(seen.corners.p1)),
            glm::normalize(pack(seen.corners.p2))};
}

PL_HD inline SeenTriangle see_triangle(const SceneView& scene, std::uint32_t primitive, Vec3f from) {
    return see_triangle(corners_of(scene, scene.triangles[primitive]), unpack(from));
}

/// Solid angle of a triangle that is sampled by solid angle; 0 of others.
PL_HD inline float near_solid_angle(const SeenTriangle& seen) {
    if (!seen.is_near()) return 0.0f;
    const float solid_angle = directions_of(seen).solid_angle();
    return solid_angle > kLeastSolidAngle && solid_angle < kMostSolidAngle ? solid_angle : 0.0f;
}

/// Barycentric weights of the triangle's point in a direction through it, kept inside against rounding.
PL_HD inline Vec3f weights_towards(const SeenTriangle& seen, Vec3f direction) {
    const CornersOf<One>& corners = seen.corners;
    const float w0 = dot(unpack(direction), cross(corners.p1, corners.p2));
    const float w1 = dot(unpack(direction), cross(corners.p2, corners.p0));
    const float w2 = dot(unpack(direction), cross(corners.p0, corners.p1));
    const float sign = w0 + w1 + w2 < 0.0f ? -1.0f : 1.0f;
    const Vec3f weights{max_of(sign * w0, 0.0f), max_of(sign * w1, 0.0f), max_of(sign * w2, 0.0f)};
    return weights * (1.0f / (weights.x + weights.y + weights.z));
}

}  // namespace pl
