// Images of a glTF file as textures of a scene.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>

#include "core/io/gltf/gltf_file.h"
#include "core/scene/description.h"

namespace pl {

/// Adds each image once for each use.
class GltfImages {
public:
    GltfImages(GltfFile& file, SceneDescription& scene) : file_(file), scene_(scene) {}

    /// Colors of the texture that the textureInfo at `info` names, with alpha times `alpha_scale`. kNoTexture if there is
    /// no such member.
    std::uint32_t color(const std::string& info, float alpha_scale = 1.0f);
    /// Numbers; the first channel is that of roughness, the third that of metalness.
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
