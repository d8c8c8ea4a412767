// What a glTF material is made of: its numbers and its images.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>

#include <glm/glm.hpp>

#include "core/io/gltf/gltf_file.h"
#include "core/scene/description.h"

namespace pl {

// Numbers of glTF materials.

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

// Images of a glTF file as textures of a scene.

/// Adds each image once for each use.
class GltfImages {
public:
    GltfImages(GltfFile& file, SceneDescription& scene) : file_(file), scene_(scene) {}

    /// Colors of the texture that the textureInfo at `info` names, with alpha times `alpha_scale`. kNoTexture if there is
    /// no such member.
    std::uint32_t color(const std::string& info, float alpha_scale = 1.0f);
    /// Numbers; the first channel is roughness, the third metalness.
    std::uint32_t roughness(const std::string& info);
    /// The same image with metalness in the first channel.
    std::uint32_t metalness(const std::string& info);
    /// Normals.
    std::uint32_t normals(const std::string& info);
    /// Glossiness from the alpha channel, as roughness.
    std::uint32_t roughness_of_gloss(const std::string& info, float factor);

private:
    enum class Use { Color, Roughness, Metalness, Gloss, Normals };
    using Key = std::tuple<std::uint32_t, Use, float, bool>;

    struct Source {
        std::uint32_t image = 0;
        bool repeats = true;
    };

    static TextureContent content_of(Use use);
    std::uint32_t add(const std::string& info, Use use, float factor);
    Source source_of(const std::string& texture);
    bool repeats(const std::string& texture);
    std::uint32_t make(const Source& source, Use use, float factor);
    std::string image_bytes(std::uint32_t image);
    std::filesystem::path image_path(std::uint32_t image) const;

    GltfFile& file_;
    SceneDescription& scene_;
    std::map<Key, std::uint32_t> known_;
};

}  // namespace pl
