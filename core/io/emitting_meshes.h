// Meshes whose materials emit by a choice that was made after their file was read.
#pragma once

#include "core/scene/description.h"

namespace pl {

/// Replaces the instances of meshes with a material that emits by copies, behind the direct triangles and in the order of the instances:
/// lights are in the scene directly. Other meshes stay. Expects valid indices.
/// Throws Error(Input) if the scene would have more than kMostStoredTriangles.
void copy_emitting_meshes(SceneDescription& scene);

}  // namespace pl
