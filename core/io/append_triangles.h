// Triangles of one description behind those of another.
#pragma once

#include "core/scene/description.h"

namespace pl {

/// Moves the direct triangles of `added`, with their positions, colors, normals and texture coordinates, and its warnings, behind those
/// of the scene. `added` has no meshes; its materials are those of the scene. Vertices of a part without colors become white if the
/// other one has some.
void append_triangles(SceneDescription added, SceneDescription& scene);

}  // namespace pl
