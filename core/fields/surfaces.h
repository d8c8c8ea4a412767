// The reflecting surfaces that radiance volumes are placed on: connected triangles that face the same way.
#pragma once

#include <array>
#include <vector>

#include "core/scene/scene_storage.h"

namespace pl {

/// Triangle of no surface: it reflects nothing or has no area.
inline constexpr std::uint32_t kNoSurface = 0xffffffffu;

/// Two normals of one surface may each be off by half of the largest angle between the normals of a volume and of
/// the points it serves: then any volume on the surface may serve any of its points. cos(acos(0.8) / 2).
inline constexpr float kMinSurfaceCosine = 0.94868330f;

/// A surface grown over shared corners from its first triangle.
struct Surface {
    std::vector<std::uint32_t> triangles;  ///< ascending
    double area = 0.0;
};

struct Surfaces {
    std::vector<Surface> list;               ///< in the order of their first triangles
    std::vector<std::uint32_t> of_triangle;  ///< [triangle], index into `list` or kNoSurface
};

/// Corners are shared if they are at the same position, whether or not the file wrote it twice.
Surfaces find_surfaces(const HostScene& scene);

/// Area of a triangle, in double.
double area_of(const SceneView& scene, std::uint32_t triangle);

/// For each surface: does light reach its front, its back?
using LitSides = std::array<bool, 2>;

/// Decides by a seeded walk of light: a side counts as lit if it receives more than a fiftieth of what arrives at
/// its surface. Surfaces that receive nothing are taken as lit from the front.
std::vector<LitSides> find_lit_sides(const HostScene& scene, const Surfaces& surfaces);

}  // namespace pl
