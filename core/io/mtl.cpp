#include "core/io/mtl.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/io/files.h"
#include "core/io/height_map.h"
#include "core/io/line_reader.h"
#include "core/io/mtl_reader.h"
#include "core/io/tally.h"
#include "core/io/texture_file.h"

namespace pl {

namespace fs = std::filesystem;

namespace {

/// Whether a texel is not gray, but for the rounding of lossy images.
bool has_colors(const TextureDescription& texture) {
    constexpr float kRounding = 0.02f;
    return std::any_of(texture.texels.begin(), texture.texels.end(), [](const glm::vec4& texel) {
        return std::abs(texel.x - texel.y) > kRounding || std::abs(texel.x - texel.z) > kRounding;
    });
}

class TextureAdder {
public:
    TextureAdder(SceneDescription& scene, const fs::path& mtl) : scene_(scene), folder_(mtl.parent_path()) {}

    std::uint32_t add(const MtlMap& map, TextureContent content) {
        if (!map) return kNoTexture;
        const fs::path path = path_of(map.name);
        if (!path.empty()) return add_texture(scene_, path, content, !map.clamps);
        return add_texture_by(scene_, folder_ / map.name, content, !map.clamps, [&]() -> TextureDescription {
            throw Error(ErrorKind::Input,
                        fmt::format("{}: expected a file in the folder of the scene, got a link out of it",
                                    (folder_ / map.name).string()));
        });
    }

    /// Exporters write images of normals as `map_Bump`, too; an image without colors is one of heights.
    std::uint32_t add_normals(const MtlEntry& entry) {
        const std::size_t before = scene_.textures.size();
        const std::uint32_t texture = add(entry.norm ? entry.norm : entry.bump, TextureContent::Normal);
        if (entry.norm || texture == kNoTexture || has_colors(scene_.textures[texture])) return texture;
        scene_.textures.resize(before);
        return add_relief(entry.bump);
    }

private:
    std::uint32_t add_relief(const MtlMap& map) {
        // The format has no unit for heights: relative to the image a relief does not depend on its resolution, nor on the model's size.
        constexpr float kRise = 0.01f;
        const std::size_t before = scene_.textures.size();
        const std::uint32_t texture = add(map, TextureContent::Height);
        if (texture >= before && texture != kNoTexture) {
            TextureDescription& heights = scene_.textures[texture];
            turn_into_normals(heights, glm::vec2(kRise * static_cast<float>(heights.width)));
        }
        return texture;
    }

    /// Absolute paths of another computer are looked up by their file name beside the MTL file. Empty if a link leads out of its folder.
    fs::path path_of(const std::string& name) const {
        const fs::path inside = path_inside(folder_, name);
        return inside.empty() ? path_inside(folder_, name.substr(name.find_last_of("/\\") + 1)) : inside;
    }

    SceneDescription& scene_;
    fs::path folder_;
};

/// Gray of 0.8, or of 0.64, its square: written beside images by exporters that do not mean it.
bool is_default_of_exporters(const std::optional<glm::vec3>& kd) {
    const auto is_gray_of = [&](float value) {
        return glm::all(glm::lessThan(glm::abs(*kd - glm::vec3(value)), glm::vec3(1e-4f)));
    };
    return kd && (is_gray_of(0.8f) || is_gray_of(0.64f));
}

}  // namespace

void load_mtl(const fs::path& path, SceneDescription& scene, MapKd map_kd) {
    TextureAdder textures(scene, path);
    Tally dimmed;
    for (MtlEntry& entry : read_mtl(read_text_file(path), path, scene.warnings)) {
        std::vector<std::string> notes;
        if (entry.map_kd && map_kd == MapKd::Replaces) {
            entry.kd.reset();
        } else if (entry.map_kd && is_default_of_exporters(entry.kd)) {
            dimmed.add(entry.line);
        }
        MaterialDescription material = surface_of(entry, notes);
        if (entry.map_kd && entry.kd == glm::vec3(0.0f)) {
            notes.emplace_back("multiplies its map_Kd with a black Kd");
        }
        const bool is_smooth = material.kind == SurfaceKind::Diffuse || material.roughness == 0.0f;
        material.textures = {
            .albedo = textures.add(entry.map_kd, TextureContent::Color),
            .roughness = is_smooth ? kNoTexture
                                   : textures.add(entry.map_pr ? entry.map_pr : entry.map_ns, TextureContent::Number),
            .emission = textures.add(entry.map_ke, TextureContent::Color),
            .opacity = textures.add(entry.map_d, TextureContent::Opacity)};
        material.textures.normal = textures.add_normals(entry);
        material.normal_strength = entry.norm ? entry.norm.strength : entry.bump.strength;
        for (const std::string& note : notes) {
            scene.warnings.push_back(
                fmt::format("{}: material {} {}", place(path, entry.line), in_quotes(entry.name), note));
        }
        scene.materials.push_back(std::move(material));
    }
    dimmed.tell(
        scene.warnings, path,
        "the image of map_Kd is multiplied by a Kd that is a default of exporters (--map-kd replace: the image "
        "alone, as Blender shows it)");
}

}  // namespace pl
