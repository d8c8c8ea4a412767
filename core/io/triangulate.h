// Triangulation of simple polygons. Replaces the triangulation of the OBJ library, which covers L-shaped polygons
// twice or not at all away from the origin, and splits concave quads along an outer diagonal.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace pl {

// Whether a triangle is large enough to be one, and the coordinates for which that can be told.

/// Of a coordinate: areas must fit in a float.
inline constexpr double kLargestCoordinate = 1e18;

/// Whether a triangle has a normal: the squared length of the cross product is a normal float, or, in scenes of any size, above the
/// rounding errors of corners on a line.
inline bool has_area(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    constexpr double kLineError = 0x1p-50;
    const glm::dvec3 origin(a);
    const glm::dvec3 ab = glm::dvec3(b) - origin;
    const glm::dvec3 ac = glm::dvec3(c) - origin;
    const glm::dvec3 n = glm::cross(ab, ac);
    const double length2 = glm::dot(n, n);
    const double line = kLineError * std::max(glm::dot(ab, ab), glm::dot(ac, ac));
    return length2 > 0.0 && length2 >= std::min(static_cast<double>(std::numeric_limits<float>::min()), line * line);
}

/// Triangles as indices into the corners of the polygon, with its orientation.
struct Triangulation {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    bool exact = true;  ///< false: the outline crosses itself or has no area; the result is a fan
};

/// Splits quads along the shorter inner diagonal and larger polygons by ear clipping, in time proportional to corners
/// x reflex corners. n >= 3 corners give n - 2 triangles. Non-planar polygons are projected along their mean normal.
Triangulation triangulate(std::span<const glm::vec3> corners);

}  // namespace pl
