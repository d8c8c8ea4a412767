// The meshes of the nodes of a glTF file as the triangles of a scene.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "core/io/gltf/nodes.h"
#include "core/io/gltf/primitives.h"
#include "core/io/obj.h"

namespace pl {

// Places of the mesh of a glTF node: its own place, or the places that the extension EXT_mesh_gpu_instancing lists.

/// JSON pointer of the extension of a node.
std::string gpu_instancing_at(std::uint32_t node);

class GltfPlacements {
public:
    /// Nodes with a skin have one place, the place of their joints. Attributes of the extension other than
    /// TRANSLATION, ROTATION and SCALE are passed over.
    /// Throws Error(Input): attributes of different lengths or of wrong types, broken accessors, rotations without a length, more than
    /// kMostInstances.
    GltfPlacements(GltfFile& file, std::uint32_t number, const GltfNode& node);

    std::uint64_t count() const { return count_; }
    glm::dmat4 to_world(std::uint64_t i) const;

private:
    std::vector<float> read(GltfFile& file, const std::string& at, const char* type);

    glm::dmat4 node_to_world_;
    std::uint64_t count_ = 1;
    std::vector<float> moves_, turns_, scales_;  ///< [place][component], or none
};

/// Adds each mesh for each shown node that names it, in the order of the nodes: as a copy, or as an instance behind all copies if
/// KeptMeshes decides so; meshes with skins as copies in the pose of their joints. Mirrored copies keep their front. Triangles too
/// small to have a normal are removed, normals of no length ignored, both with a note. `groups`, if it is not null, has a group for
/// each node with a mesh; everything is copied then.
/// Throws Error(Input): broken meshes and places, coordinates beyond kLargestCoordinate, more than kMostStoredTriangles,
/// kMostShownTriangles or kMostInstances.
void add_gltf_triangles(GltfFile& file, const GltfNodes& nodes, std::vector<GltfSurface> surfaces,
                        SceneDescription& scene, MeshGroups* groups, std::uint64_t most_copied_triangles);

}  // namespace pl
