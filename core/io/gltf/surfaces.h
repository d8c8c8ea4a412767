// Materials of a glTF file as the surfaces that the renderer knows; docs/materials.md has the table.
#pragma once

#include <cstdint>
#include <vector>

#include "core/io/gltf/gltf_file.h"
#include "core/io/gltf/uv_mapping.h"
#include "core/scene/description.h"

namespace pl {

/// A material of the file.
struct GltfSurface {
    std::uint32_t material = 0;  ///< index into SceneDescription::materials
    UvMapping uv{};              ///< of all images
    bool is_anisotropic = false;
    bool is_hidden = false;  ///< fully transparent everywhere
};

/// Adds the materials and images of the file to the scene. The last surface is that of triangles without a material.
std::vector<GltfSurface> read_surfaces(GltfFile& file, SceneDescription& scene);

}  // namespace pl
