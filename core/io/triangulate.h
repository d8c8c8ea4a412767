// Triangulation of simple polygons. Replaces that of the OBJ library, which covers L-shaped polygons twice or not at
// all away from the origin, and splits concave quads along an outer diagonal.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace pl {

/// Triangles as indices into the corners of the polygon, with its orientation.
struct Triangulation {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    bool exact = true;  ///< false: the outline crosses itself or has no area; the result is a fan
};

/// Splits quads along the shorter inner diagonal and larger polygons by ear clipping, in time proportional to corners
/// x reflex corners. n >= 3 corners give n - 2 triangles. Non-planar polygons are projected along their mean normal.
Triangulation triangulate(std::span<const glm::vec3> corners);

}  // namespace pl
