// Places of the mesh of a glTF node: its own one, or those that the extension EXT_mesh_gpu_instancing lists.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "core/io/gltf/nodes.h"

namespace pl {

/// JSON pointer of the extension of a node.
std::string gpu_instancing_at(std::uint32_t node);

class GltfPlacements {
public:
    /// Nodes with a skin have one place: that of their joints. Attributes of the extension other than TRANSLATION, ROTATION and SCALE
    /// are passed over.
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

}  // namespace pl
