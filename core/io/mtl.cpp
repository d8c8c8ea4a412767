#include "core/io/mtl.h"

#include <fmt/format.h>

#include "core/io/files.h"
#include "core/io/line_reader.h"
#include "core/io/mtl_reader.h"
#include "core/io/texture_file.h"

namespace pl {

namespace fs = std::filesystem;

namespace {

class TextureAdder {
public:
    TextureAdder(SceneDescription& scene, const fs::path& mtl) : scene_(scene), folder_(mtl.parent_path()) {}

    std::uint32_t add(const MtlMap& map, TextureContent content) {
        return map ? add_texture(scene_, path_of(map.name), content, !map.clamps) : kNoTexture;
    }

private:
    /// Absolute paths of another computer are looked up by their file name beside the MTL file.
    fs::path path_of(const std::string& name) const {
        const fs::path inside = path_inside(folder_, name);
        return inside.empty() ? folder_ / name.substr(name.find_last_of("/\\") + 1) : inside;
    }

    SceneDescription& scene_;
    fs::path folder_;
};

}  // namespace

void load_mtl(const fs::path& path, SceneDescription& scene) {
    TextureAdder textures(scene, path);
    for (const MtlEntry& entry : read_mtl(read_text_file(path), path, scene.warnings)) {
        std::vector<std::string> notes;
        MaterialDescription material = surface_of(entry, notes);
        if (entry.map_kd && entry.kd == glm::vec3(0.0f)) {
            notes.emplace_back("multiplies its map_Kd with a black Kd");
        }
        for (const std::string& note : notes) {
            scene.warnings.push_back(
                fmt::format("{}: material {} {}", place(path, entry.line), in_quotes(entry.name), note));
        }
        const bool is_smooth = material.kind == SurfaceKind::Diffuse || material.roughness == 0.0f;
        material.textures = {
            .albedo = textures.add(entry.map_kd, TextureContent::Color),
            .roughness = is_smooth ? kNoTexture
                                   : textures.add(entry.map_pr ? entry.map_pr : entry.map_ns, TextureContent::Number),
            .emission = textures.add(entry.map_ke, TextureContent::Color),
            .opacity = textures.add(entry.map_d, TextureContent::Opacity)};
        scene.materials.push_back(std::move(material));
    }
}

}  // namespace pl
