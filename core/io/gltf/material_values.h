// Numbers of glTF materials.
#pragma once

#include <string>

#include <glm/glm.hpp>

#include "core/io/gltf/gltf_file.h"
#include "core/scene/description.h"

namespace pl {

// Numbers out of their range are moved into it, with a note.

float clamped_number(GltfFile& file, const std::string& pointer, float standard, float least, float most);

/// `length` of at most 4 numbers within [0, 1]; those that are not given are 1.
glm::vec4 clamped_shares(GltfFile& file, const std::string& pointer, std::size_t length);

/// Share of metal, over a surface.
struct Metalness {
    float least = 0.0f, mean = 0.0f, most = 0.0f;
};

/// Of a factor times the third channel of a texture of the scene, or of kNoTexture.
Metalness metalness_of(const SceneDescription& scene, std::uint32_t texture, float factor);

/// Makes the facets of a metal wider along the direction of u, in a copy of its image of roughness, too, if it has one. Returns whether
/// the anisotropy is within kMostAnisotropy. [KHR_materials_anisotropy]
bool stretch_facets(SceneDescription& scene, float strength, MaterialDescription& metal);

/// Three numbers as they are.
glm::vec3 color_or(const JsonDocument& document, const std::string& pointer, const glm::vec3& standard);

}  // namespace pl
