#include "core/io/gltf/gltf.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/error.h"
#include "core/io/gltf/nodes.h"
#include "core/io/gltf/triangles.h"
#include "core/scene/far_origin.h"

namespace pl {
namespace {

/// Extensions that are read, change no picture, or are noted where they are used.
bool is_known(const std::string& extension) {
    constexpr std::array<std::string_view, 10> kKnown = {
        "EXT_mesh_gpu_instancing", "KHR_lights_punctual", "KHR_mesh_quantization",
        "KHR_texture_transform",   "KHR_texture_basisu",  "EXT_texture_webp",
        "EXT_texture_avif",        "MSFT_texture_dds",    "KHR_xmp",
        "KHR_xmp_json_ld"};
    return extension.starts_with("KHR_materials_") ||
           std::find(kKnown.begin(), kKnown.end(), extension) != kKnown.end();
}

void note_the_rest(GltfFile& file) {
    for (std::size_t i = 0; i < file.json().array_size("/extensionsUsed"); ++i) {
        const std::string pointer = fmt::format("/extensionsUsed/{}", i);
        const std::string name = file.json().text(pointer).value_or("");
        if (!is_known(name)) file.note(fmt::format("the extension {} is left out", name), pointer);
    }
    if (file.json().array_size("/animations") > 0)
        file.note("animations are left out: everything is in the place of its node", "/animations/0");
}

[[noreturn]] void fail_empty(const GltfFile& file) {
    std::vector<std::string> reasons;
    file.notes().tell(reasons);
    throw Error(ErrorKind::Input,
                fmt::format("{}: expected a mesh in the scene that is shown, got no triangle with an "
                            "area{}{}",
                            file.path().string(), reasons.empty() ? "" : "; ", fmt::join(reasons, "; ")));
}

SceneDescription load_from(const glm::dvec3& origin, const std::filesystem::path& path, MeshGroups* groups,
                           std::uint64_t most_copied_triangles) {
    GltfFile file(path);
    SceneDescription scene;
    scene.source = path;
    scene.origin = origin;
    tell_origin(scene);
    const GltfNodes nodes = read_nodes(file, origin);
    add_gltf_triangles(file, nodes, read_surfaces(file, scene), scene, groups, most_copied_triangles);
    const bool is_read_again = origin == glm::dvec3(0.0) && far_origin(scene) != glm::dvec3(0.0);
    if (scene.triangles.empty() && !is_read_again) fail_empty(file);
    add_gltf_cameras(file, nodes, scene);
    add_gltf_lights(file, nodes, scene);
    note_the_rest(file);
    file.notes().tell(scene.warnings);
    scene.files = file.files();
    return scene;
}

}  // namespace

SceneDescription load_gltf(const std::filesystem::path& path, MeshGroups* groups,
                           std::uint64_t most_copied_triangles) {
    SceneDescription scene = load_from(glm::dvec3(0.0), path, groups, most_copied_triangles);
    const glm::dvec3 origin = far_origin(scene);
    if (origin == glm::dvec3(0.0)) return scene;
    if (groups != nullptr) *groups = {};
    return load_from(origin, path, groups, most_copied_triangles);
}

}  // namespace pl
