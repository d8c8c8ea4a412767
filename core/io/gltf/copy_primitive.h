// Copies of the primitives of a glTF file in a place.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "core/io/gltf/primitives.h"

namespace pl {

/// A place of a mesh.
struct GltfPlace {
    glm::dmat4 to_world{1.0};
    std::vector<glm::dmat4>
        joints{};  ///< of the skin, in its pose, which replace `to_world` for primitives with joints; or none
};

/// Adds the vertices of a primitive in a place, and its triangles. Mirrored ones keep their front. Triangles too small to have a normal
/// are left out, normals of no length ignored, both with a note. Vertices without a color, of which there may be some behind those with
/// one, are white.
/// Throws Error(Input): coordinates beyond kLargestCoordinate, joints that the skin does not have.
void copy_gltf_primitive(GltfFile& file, const GltfPrimitive& primitive, std::uint32_t material,
                         const GltfPlace& place, SceneDescription& to);

}  // namespace pl
