// Shapes of Mitsuba as triangles.
#pragma once

#include "core/io/mitsuba/round_shapes.h"
#include "core/io/mitsuba/xml_file.h"
#include "core/scene/description.h"

namespace pl {

/// The material of a shape.
struct ShapeMaterial {
    std::uint32_t index = 0;
    bool shows_vertex_colors = false;
    bool emits = false;
    bool is_inside_out = false;  ///< the front of its shapes is their other side
};

/// Adds the triangles of a `shape` element with this material: obj, ply, serialized, rectangle, cube, disk and sphere, the last two as
/// meshes as fine as their numbers in the file allow; others are left out with a note. Meshes without normals are smooth
/// unless they have `faceNormals`, as in Mitsuba; missing files are left out with a note. Throws Error(Input).
void add_mitsuba_shape(const MitsubaObject& shape, const ShapeMaterial& material, const RoundShapes& round_shapes,
                       SceneDescription& scene);

/// The triangles of a group of shapes in a place, without the group's warnings; mirrored ones keep their front.
/// Throws Error(Input) at the `instance` element for coordinates beyond kLargestCoordinate.
SceneDescription copy_of_group(const MitsubaObject& instance, const SceneDescription& group,
                               const glm::dmat4& to_world);

}  // namespace pl
