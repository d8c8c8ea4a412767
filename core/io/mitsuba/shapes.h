// Shapes of Mitsuba as triangles.
#pragma once

#include "core/io/mitsuba/xml_file.h"
#include "core/scene/description.h"

namespace pl {

/// Adds the triangles of a `shape` element with this material: obj, ply, rectangle, cube, disk and sphere, the last two as fine
/// meshes; others are left out with a note. Meshes without normals are smooth unless they have `faceNormals`, as in Mitsuba.
/// Throws Error(Input).
void add_mitsuba_shape(const MitsubaObject& shape, std::uint32_t material, SceneDescription& scene);

}  // namespace pl
