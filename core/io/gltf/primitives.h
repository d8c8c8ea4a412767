// Primitives of the meshes of a glTF file as triangles, in the coordinates of their mesh.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "core/io/gltf/gltf_file.h"
#include "core/io/gltf/surfaces.h"

namespace pl {

struct GltfPrimitive {
    std::string at;  ///< JSON pointer
    std::uint32_t surface = 0;
    std::vector<glm::vec3> positions{};
    std::vector<glm::vec3> normals{};     ///< per vertex, or none
    std::vector<glm::vec2> uvs{};         ///< per vertex, or none; as UvMapping::apply() gives them
    std::vector<glm::vec3> colors{};      ///< per vertex, in [0, 1], or none
    std::vector<std::uint32_t> joints{};  ///< [vertex][4], or none: indices into the joints of a skin
    std::vector<float> weights{};         ///< [vertex][4]
    std::vector<std::array<std::uint32_t, 3>> triangles{};
};

/// Reads each mesh once.
class GltfMeshes {
public:
    /// `surfaces` and the materials of the scene get the entries that opacities of vertices need. The last surface
    /// belongs to primitives without a material.
    GltfMeshes(GltfFile& file, std::vector<GltfSurface>& surfaces, SceneDescription& scene)
        : file_(file), surfaces_(surfaces), standard_(static_cast<std::uint32_t>(surfaces.size() - 1)),
          opacities_(file, surfaces, scene) {}

    /// Valid as long as this object.
    const std::vector<GltfPrimitive>& mesh(std::uint32_t number);

private:
    GltfPrimitive read(const std::string& at);
    void read_attributes(GltfPrimitive& primitive);
    void read_colors(GltfPrimitive& primitive);
    void read_uvs(GltfPrimitive& primitive, std::size_t vertices);
    void read_triangles(GltfPrimitive& primitive);
    std::vector<std::uint32_t> read_corners(const GltfPrimitive& primitive);
    /// The accessor of an attribute, which must have as many elements as there are vertices.
    std::optional<std::uint32_t> attribute(const GltfPrimitive& primitive, const std::string& name);
    /// Adds to the elements that the file makes the program keep. Throws Error(Input) if they are too many.
    void count(const std::string& at, std::uint64_t elements);

    GltfFile& file_;
    const std::vector<GltfSurface>& surfaces_;
    std::uint32_t standard_;
    VertexOpacities opacities_;
    std::map<std::uint32_t, std::vector<GltfPrimitive>> known_;
    std::uint64_t elements_ = 0;
};

// Copies of the primitives of a glTF file in a place.

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
