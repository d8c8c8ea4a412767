// Shapes of Mitsuba as triangles.
#pragma once

#include "core/io/mitsuba/xml_file.h"
#include "core/scene/description.h"

namespace pl {

/// The material of a shape.
struct ShapeMaterial {
    std::uint32_t index = 0;
    bool shows_vertex_colors = false;
};

/// Adds the triangles of a `shape` element with this material: obj, ply, serialized, rectangle, cube, disk and sphere, the last two as fine
/// meshes; others are left out with a note. Meshes without normals are smooth unless they have `faceNormals`, as in Mitsuba.
/// Throws Error(Input).
void add_mitsuba_shape(const MitsubaObject& shape, const ShapeMaterial& material, SceneDescription& scene);

/// Most triangles and vertices of a scene with all its instances.
inline constexpr std::size_t kMostMitsubaTriangles = std::size_t{1} << 26;
inline constexpr std::size_t kMostMitsubaVertices = std::size_t{1} << 27;

/// Adds a copy of the triangles of a group of shapes in the place of an `instance` element. Throws Error(Input) if the scene would
/// have more than kMostMitsubaTriangles or coordinates beyond kLargestCoordinate.
void add_mitsuba_instance(const MitsubaObject& instance, const SceneDescription& group, SceneDescription& scene);

}  // namespace pl
