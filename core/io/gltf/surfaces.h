// Materials of a glTF file as the surfaces that the renderer knows; docs/materials.md has the table.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "core/io/gltf/gltf_file.h"
#include "core/io/gltf/uv_mapping.h"
#include "core/scene/description.h"

namespace pl {

/// A material of the file, in one or two materials of the scene.
struct GltfSurface {
    std::uint32_t material = 0;                  ///< index into SceneDescription::materials
    std::uint32_t metal = 0;                     ///< the same as a metal, for triangles where the image says so
    std::uint32_t metalness_image = kNoTexture;  ///< its blue channel decides between the two; kNoTexture: `material`
    float metalness = 1.0f;                      ///< multiplies the image
    UvMapping uv{};                              ///< of all images
    bool is_hidden = false;                      ///< fully transparent everywhere

    /// The material of a triangle whose middle has these texture coordinates.
    std::uint32_t material_at(const SceneDescription& scene, glm::vec2 middle) const;
};

/// Adds the materials and images of the file to the scene. The last surface is that of triangles without a material.
std::vector<GltfSurface> read_surfaces(GltfFile& file, SceneDescription& scene);

}  // namespace pl
