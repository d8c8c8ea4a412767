#include "core/io/gltf/surfaces.h"

#include <set>

#include <fmt/format.h>

#include "core/io/gltf/surface_reader.h"

namespace pl {
namespace {

/// Whether triangles use the material of the format for those without one.
bool needs_standard(const GltfFile& file) {
    for (std::size_t mesh = 0; mesh < file.json().array_size("/meshes"); ++mesh) {
        const std::string at = fmt::format("/meshes/{}/primitives", mesh);
        for (std::size_t i = 0; i < file.json().array_size(at); ++i)
            if (!file.json().has(fmt::format("{}/{}/material", at, i))) return true;
    }
    return false;
}

}  // namespace

std::vector<GltfSurface> read_surfaces(GltfFile& file, SceneDescription& scene) {
    GltfImages images(file, scene);
    std::vector<GltfSurface> surfaces;
    std::set<std::string> names;
    const auto count = static_cast<std::uint32_t>(file.json().array_size("/materials"));
    for (std::uint32_t i = 0; i < count; ++i) {
        std::string name = file.name_of(fmt::format("/materials/{}", i), "material", i);
        if (!names.insert(name).second) {
            name += fmt::format(" ({})", i);
            names.insert(name);
        }
        surfaces.push_back(read_surface(file, scene, images, i, name));
    }
    surfaces.emplace_back();
    if (needs_standard(file)) {
        file.note("triangles without a material: in the standard of the format, a rough white metal", "/meshes");
        surfaces.back() = read_surface(file, scene, images, count, "standard");
    }
    return surfaces;
}

}  // namespace pl
