// Texture coordinates of the images of glTF materials.
#pragma once

#include <cstdint>
#include <string>

#include <glm/glm.hpp>

#include "core/io/gltf/gltf_file.h"

namespace pl {

/// Choice and transformation of texture coordinates. [KHR_texture_transform]
struct UvMapping {
    std::uint32_t set = 0;
    glm::vec2 offset{0.0f};
    glm::vec2 scale{1.0f};
    float rotation = 0.0f;  ///< radians

    /// From coordinates of the file, v downwards, to those of the renderer, v upwards.
    glm::vec2 apply(glm::vec2 uv) const;
    friend bool operator==(const UvMapping&, const UvMapping&) = default;
};

/// Of the textureInfo at `info`.
UvMapping read_uv_mapping(const GltfFile& file, const std::string& info);

}  // namespace pl
