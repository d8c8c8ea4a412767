// The reflecting surfaces that radiance volumes are placed on: connected triangles that are in the scene directly,
// with nearly the same normal.
#pragma once

#include <array>
#include <vector>

#include "core/scene/scene_storage.h"

namespace pl {

/// Primitive of no surface: it reflects nothing, has no area, or is of an instance.
inline constexpr std::uint32_t kNoSurface = 0xffffffffu;

/// Each normal of a surface deviates from the normal of its first triangle by at most half of the largest angle
/// between the normals of a volume and of the points it serves: then any volume on the surface may serve any point of
/// the surface. cos(acos(0.8) / 2).
inline constexpr float kMinSurfaceCosine = 0.94868330f;

/// A surface grown over shared corners from its first triangle.
struct Surface {
    std::vector<std::uint32_t> triangles;  ///< ascending
    double area = 0.0;
};

struct Surfaces {
    std::vector<Surface> list;               ///< in the order of their first triangles
    std::vector<std::uint32_t> of_triangle;  ///< [triangle], index into `list` or kNoSurface

    std::uint32_t of_primitive(std::uint32_t primitive) const {
        return primitive < of_triangle.size() ? of_triangle[primitive] : kNoSurface;
    }
};

/// Triangles are connected if they share a position, whether or not the file lists it twice.
Surfaces find_surfaces(const HostScene& scene, int threads = 1);

/// Area of a triangle, in double.
double area_of(const SceneView& scene, std::uint32_t triangle);

/// For each surface, whether light reaches its front and its back.
using LitSides = std::array<bool, 2>;

/// Decided by a seeded light walk: a side counts as lit if it receives more than a fiftieth of the arrivals at its
/// surface. Surfaces without arrivals are taken as lit from the front.
std::vector<LitSides> find_lit_sides(const HostScene& scene, const Surfaces& surfaces, int threads = 1);

/// Both, for a scene with its materials: placing and every round of refinement need them.
struct LitSurfaces {
    Surfaces surfaces;
    std::vector<LitSides> lit;  ///< [surface]

    /// Whether light reaches this side of a triangle; false for triangles of no surface.
    bool is_lit(std::uint32_t primitive, bool front) const {
        const std::uint32_t surface = surfaces.of_primitive(primitive);
        return surface != kNoSurface && lit[surface][front ? 0 : 1];
    }
};
LitSurfaces find_lit_surfaces(const HostScene& scene, int threads = 1);

}  // namespace pl
