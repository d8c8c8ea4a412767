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
struct SeenTriangle {
    Vec3f p0, p1, p2;  ///< corners relative to the point
    float area = 0.0f;

    PL_HD bool is_near() const {
        const Vec3f centroid = (p0 + p1 + p2) * (1.0f / 3.0f);
        return glm::dot(centroid, centroid) < kNearDistance * area;
    }
    PL_HD SphericalTriangle directions() const {
        return {glm::normalize(p0), glm::normalize(p1), glm::normalize(p2)};
    }
};

PL_HD inline SeenTriangle see_triangle(const SceneView& scene, std::uint32_t primitive, Vec3f from) {
    const Triangle& triangle = scene.triangles[primitive];
    SeenTriangle seen{scene.positions[triangle.v0] - from, scene.positions[triangle.v1] - from,
                      scene.positions[triangle.v2] - from};
    seen.area = 0.5f * glm::length(triangle_cross(seen.p0, seen.p1, seen.p2));
    return seen;
}

/// Solid angle of a triangle that is sampled by solid angle; 0 of others.
PL_HD inline float near_solid_angle(const SeenTriangle& seen) {
    if (!seen.is_near()) return 0.0f;
    const float solid_angle = seen.directions().solid_angle();
    return solid_angle > kLeastSolidAngle && solid_angle < kMostSolidAngle ? solid_angle : 0.0f;
}

/// Barycentric weights of the triangle's point in a direction through it, kept inside against rounding.
PL_HD inline Vec3f weights_towards(const SeenTriangle& seen, Vec3f direction) {
    const float w0 = glm::dot(direction, glm::cross(seen.p1, seen.p2));
    const float w1 = glm::dot(direction, glm::cross(seen.p2, seen.p0));
    const float w2 = glm::dot(direction, glm::cross(seen.p0, seen.p1));
    const float sign = w0 + w1 + w2 < 0.0f ? -1.0f : 1.0f;
    const Vec3f weights{max_of(sign * w0, 0.0f), max_of(sign * w1, 0.0f), max_of(sign * w2, 0.0f)};
    return weights * (1.0f / (weights.x + weights.y + weights.z));
}

}  // namespace pl
