// Materials of a glTF file as the surfaces that the renderer knows; docs/materials.md has the table.
#pragma once

#include <cstdint>
#include <vector>

#include "core/io/gltf/gltf_file.h"
#include "core/io/gltf/uv_mapping.h"
#include "core/scene/description.h"

namespace pl {

/// The effect of the opacity of vertices, which multiplies that of the base color.
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

/// Adds the materials and images of the file to the scene. The last surface is that of triangles without a material.
std::vector<GltfSurface> read_surfaces(GltfFile& file, SceneDescription& scene);

}  // namespace pl
