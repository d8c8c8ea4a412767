// TrianglePlane of a triangle, computed in double: normal, offset from the plane and margin to the edges such that no
// ray intersects the surface it starts on or misses an adjacent one.
#pragma once

#include "core/kernel/scene/scene_view.h"

namespace pl {

/// Distance of a position from barycentric weights to the true plane, in roundoffs of the coordinates per axis: sum
/// of the weights 2, its inverse 1, weight 1, product with the corner 1, sum of the corners 2.
inline constexpr double kPositionError = gamma_bound(7);

/// Roundoffs of the offset from the plane: the addition 1, one more float 2.
inline constexpr double kMoveError = gamma_bound(3);

/// Error of the ray test for a ray that starts close to the plane, in roundoffs of the triangle's longest edge. The
/// test translates corners to the origin (1 roundoff) and shears them (3, and 2 of the result), in two coordinates: 6
/// sqrt(2). The products of its edge functions add 2 for a triangle as high as long. Slivers add more, but only for
/// grazing rays: walks along the edges of strips of 3 mm by 3 m find such rays, 1.5e8 segments of diffuse paths did
/// not.
inline constexpr double kTestError = gamma_bound(11);

/// Adjacent walls may meet at an angle: down to the inverse of this factor, the sine of 3.6 degrees, the bounds hold
/// along the wall; with the offset from the plane, which also leads towards the other wall, down to about 8 degrees.
inline constexpr double kEdgeMarginFactor = 16.0;

/// Upper bound on the margin, as a barycentric weight.
inline constexpr double kMaxEdgeMargin = 1.0 / 16.0;

struct TriangleCorners {
    Vec3d p[3];

    PL_HD TriangleCorners(Vec3f p0, Vec3f p1, Vec3f p2) : p{Vec3d{p0}, Vec3d{p1}, Vec3d{p2}} {}
    PL_HD TriangleCorners(Span<const Vec3f> positions, const Triangle& t)
        : TriangleCorners(positions[t.v0], positions[t.v1], positions[t.v2]) {}

    /// Unnormalized normal; its length is twice the area.
    PL_HD Vec3d cross() const { return glm::cross(p[1] - p[0], p[2] - p[0]); }
    PL_HD double longest_edge() const {
        const auto square = [](const Vec3d& v) { return glm::dot(v, v); };
        return std::sqrt(max_of(square(p[1] - p[0]), max_of(square(p[2] - p[1]), square(p[0] - p[2]))));
    }
    /// Largest magnitude of the corners per coordinate.
    PL_HD Vec3d reach() const { return glm::max(glm::abs(p[0]), glm::max(glm::abs(p[1]), glm::abs(p[2]))); }
};

/// `scene_edge`: the longest edge of the scene, a bound for the adjacent triangles. A degenerate triangle gets an
/// arbitrary unit normal instead of NaN.
PL_HD inline TrianglePlane make_triangle_plane(const TriangleCorners& corners, double scene_edge) {
    const Vec3d cross = corners.cross();
    const double twice_area = glm::length(cross);
    if (!(twice_area > 0.0)) return {{0.0f, 1.0f, 0.0f}, 0.0f, static_cast<float>(kMaxEdgeMargin)};
    const Vec3d normal = cross / twice_area;
    const Vec3d reach = corners.reach();
    const double edge = corners.longest_edge();
    const double step = kPositionError * glm::dot(glm::abs(normal), reach) + kTestError * edge;
    const double margin = (kPositionError + kMoveError) * glm::length(reach) + kTestError * scene_edge;
    const double smallest_height = twice_area / edge;
    return {Vec3f{normal}, static_cast<float>(step),
            static_cast<float>(min_of(kEdgeMarginFactor * margin / smallest_height, kMaxEdgeMargin))};
}

}  // namespace pl
