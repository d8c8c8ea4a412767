// The meshes of the nodes of a glTF file as the triangles of a scene.
#pragma once

#include "core/io/gltf/nodes.h"
#include "core/io/gltf/primitives.h"
#include "core/io/obj.h"

namespace pl {

/// Adds each mesh for each shown node that names it, in the order of the nodes: as a copy, or as an instance behind all copies if
/// KeptMeshes decides so; meshes with skins as copies in the pose of their joints. Mirrored copies keep their front. Triangles too
/// small to have a normal are removed, normals of no length ignored, both with a note. `groups`, if it is not null, has a group for
/// each node with a mesh; everything is copied then.
/// Throws Error(Input): broken meshes and places, coordinates beyond kLargestCoordinate, more than kMostStoredTriangles,
/// kMostShownTriangles or kMostInstances.
void add_gltf_triangles(GltfFile& file, const GltfNodes& nodes, std::vector<GltfSurface> surfaces,
                        SceneDescription& scene, MeshGroups* groups, std::uint64_t most_copied_triangles);

}  // namespace pl
