// The meshes of the nodes of a glTF file as the triangles of a scene.
#pragma once

#include "core/io/gltf/nodes.h"
#include "core/io/gltf/primitives.h"
#include "core/io/obj.h"

namespace pl {

/// Adds a copy of each mesh for each shown node that names it, in the order of the nodes; meshes with skins in the pose of
/// their joints. Mirrored copies keep their front. Triangles too small to have a normal are removed, normals of no length
/// ignored, both with a note. `groups`, if it is not null, has a group for each node with a mesh.
/// Throws Error(Input): broken meshes, coordinates beyond kLargestCoordinate, more than kMostGltfTriangles.
void add_gltf_triangles(GltfFile& file, const GltfNodes& nodes, const std::vector<GltfSurface>& surfaces,
                        SceneDescription& scene, MeshGroups* groups);

}  // namespace pl
