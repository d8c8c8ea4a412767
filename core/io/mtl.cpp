#include "core/io/mtl.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/io/files.h"
#include "core/io/height_map.h"
#include "core/io/line_reader.h"
#include "core/io/mtl_reader.h"
#include "core/io/obj_names.h"
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

fs::path folder_of_scene(const SceneDescription& scene, const fs::path& mtl) {
    return scene.source.empty() ? mtl.parent_path() : scene.source.parent_path();
}

class TextureAdder {
public:
    TextureAdder(SceneDescription& scene, const fs::path& mtl)
        : scene_(scene), mtl_(mtl), root_(folder_of_scene(scene, mtl)) {
        const fs::path relative = mtl.parent_path().lexically_relative(root_);
        from_ = relative == "." ? fs::path() : relative;
    }

    std::uint32_t add(const MtlMap& map, TextureContent content) {
        if (!map) return kNoTexture;
        const NamedFile file = find_named_file(root_, from_, map.name, NamedKind::Image);
        if (!file.is_there && file.is_elsewhere) {
            return add_texture_by(scene_, file.path, content, !map.clamps, [&]() -> TextureDescription {
                throw Error(ErrorKind::Input,
                            fmt::format("{}: {} is outside of the scene's folder, where none of its "
                                        "name is",
                                        place(mtl_, map.line), in_quotes(map.name)));
            });
        }
        if (file.is_elsewhere && moved_names_.insert(map.name).second) {
            moved_.add(map.line,
                       [&] { return fmt::format("image {}: {}", in_quotes(map.name), file.path.string()); });
        }
        return add_texture(scene_, file.path, content, !map.clamps);
    }

    /// Exporters write images of normals as `map_Bump`, too; an image without colors is one of heights.
    std::uint32_t add_normals(const MtlEntry& entry) {
        const std::size_t before = scene_.textures.size();
        const std::uint32_t texture = add(entry.norm ? entry.norm : entry.bump, TextureContent::Normal);
        if (entry.norm || texture == kNoTexture || has_colors(scene_.textures[texture])) return texture;
        scene_.textures.resize(before);
        return add_relief(entry.bump);
    }

    void tell() const { moved_.tell(scene_.warnings, mtl_, "read, because the named one is not there"); }

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

    SceneDescription& scene_;
    const fs::path& mtl_;
    fs::path root_;
    fs::path from_;  ///< folder of the file, from `root_`
    std::set<std::string> moved_names_;
    Tally moved_;
};

/// The place of the images of a material: that of the first one. `differs` if not all are there.
UvScale uvs_of(const MtlEntry& entry, bool& differs) {
    const MtlMap* first = nullptr;
    for (const MtlMap* map : {&entry.map_kd, &entry.map_ke, entry.map_pr ? &entry.map_pr : &entry.map_ns,
                              &entry.map_d, entry.norm ? &entry.norm : &entry.bump}) {
        if (!*map) continue;
        first = first == nullptr ? map : first;
        differs = differs || !(map->uvs == first->uvs);
    }
    return first == nullptr ? UvScale{} : first->uvs;
}

/// Gray of 0.8, or of 0.64, its square: written beside images by exporters that do not mean it.
bool is_default_of_exporters(const std::optional<glm::vec3>& kd) {
    const auto is_gray_of = [&](float value) {
        return glm::all(glm::lessThan(glm::abs(*kd - glm::vec3(value)), glm::vec3(1e-4f)));
    };
    return kd && (is_gray_of(0.8f) || is_gray_of(0.64f));
}

}  // namespace

std::vector<UvScale> load_mtl(const fs::path& path, SceneDescription& scene, MapKd map_kd) {
    TextureAdder textures(scene, path);
    Tally dimmed;
    Tally differing;
    std::vector<UvScale> uvs;
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
        bool differs = false;
        uvs.push_back(uvs_of(entry, differs));
        if (differs) differing.add(entry.line);
    }
    textures.tell();
    differing.tell(scene.warnings, path, "images of one material with different -s or -o: those of the first count");
    dimmed.tell(scene.warnings, path,
                "the image of map_Kd is multiplied by a Kd that is a default of exporters (\"map_kd\": \"replace\" "
                "in a scene "
                "file: the image alone, as Blender shows it)");
    return uvs;
}

}  // namespace pl
