// Cuts a polygon into triangles that cover exactly its area.
// The built-in triangulation of the OBJ library is not used: it covers L-shaped polygons twice or not at all when
// they lie away from the origin, and cuts concave quads along a diagonal outside of them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace pl {

/// Triangles as positions in the polygon's corner list, with the polygon's orientation.
struct Triangulation {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    bool exact = true;  ///< false: the outline crosses itself or has no area, and this is a plain fan
};

/// Quads are cut along the shorter diagonal inside them, larger polygons by clipping ears; a polygon of n corners
/// gives n - 2 triangles. Corners that are not in one plane are judged by their projection along the polygon's mean
/// normal. At least 3 corners. Ear clipping takes time proportional to corners times reflex corners.
Triangulation triangulate(std::span<const glm::vec3> corners);

}  // namespace pl
