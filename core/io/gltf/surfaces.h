// Materials of a glTF file as the surfaces that the renderer knows; docs/materials.md has the table.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "core/io/gltf/gltf_file.h"
#include "core/scene/description.h"

namespace pl {

// Texture coordinates of the images of glTF materials.

/// Choice and transformation of texture coordinates. [KHR_texture_transform]
struct UvMapping {
    std::uint32_t set = 0;
    glm::vec2 offset{0.0f};
    glm::vec2 scale{1.0f};
    float rotation = 0.0f;  ///< radians

    /// From coordinates of the file, v downwards, to coordinates of the renderer, v upwards.
    glm::vec2 apply(glm::vec2 uv) const;
    friend bool operator==(const UvMapping&, const UvMapping&) = default;
};

/// Of the textureInfo at `info`.
UvMapping read_uv_mapping(const GltfFile& file, const std::string& info);

/// The effect of the opacity of vertices, which multiplies the opacity of the base color.
enum class VertexAlpha : std::uint32_t {
    Ignored,  ///< OPAQUE
    Scales,   ///< the opacity of the material: BLEND, and MASK by an image
    Cut,      ///< MASK without an image: the surface is solid or hidden
    LeftOut,  ///< MASK by an image whose scaled opacities end at 1 before the cutoff is met
};

/// A material of the file.
struct GltfSurface {
    std::uint32_t material = 0;  ///< index into SceneDescription::materials
    UvMapping uv{};              ///< of all images
    bool is_anisotropic = false;
    bool is_hidden = false;  ///< fully transparent everywhere
    VertexAlpha vertex_alpha = VertexAlpha::Ignored;
    float least_alpha = 0.0f;  ///< VertexAlpha::Cut: least opacity of vertices at which the surface is solid
};

/// Adds the materials and images of the file to the scene. The last surface belongs to triangles without a material.
std::vector<GltfSurface> read_surfaces(GltfFile& file, SceneDescription& scene);

// Opacities of the vertices of glTF primitives, which multiply the opacities of materials.

/// The opacities of the vertices of a primitive, in [0, 1].
struct OpacityRange {
    float least = 1.0f;
    float most = 1.0f;
};

/// The renderer knows one opacity for each material: primitives whose vertices have the same one get a copy of their material.
class VertexOpacities {
public:
    VertexOpacities(GltfFile& file, std::vector<GltfSurface>& surfaces, SceneDescription& scene)
        : file_(file), surfaces_(surfaces), scene_(scene) {}

    /// The surface of a primitive at `at` whose vertices have these opacities. Adds it, with its material, if there is none such. Opacities
    /// that cannot be shown are noted.
    std::uint32_t surface_with(std::uint32_t surface, const OpacityRange& range, const std::string& at);

private:
    std::uint32_t scaled(std::uint32_t surface, float opacity);
    std::string free_name(const std::string& name, float opacity);

    GltfFile& file_;
    std::vector<GltfSurface>& surfaces_;
    SceneDescription& scene_;
    std::map<std::pair<std::uint32_t, float>, std::uint32_t> known_;  ///< by surface and opacity
    std::set<std::string> names_;                                     ///< of all materials
};

}  // namespace pl
