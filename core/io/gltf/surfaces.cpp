#include "core/io/gltf/surfaces.h"

#include <algorithm>
#include <cmath>
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

std::uint32_t GltfSurface::material_at(const SceneDescription& scene, glm::vec2 middle) const {
    if (metalness_image == kNoTexture || !std::isfinite(middle.x) || !std::isfinite(middle.y)) return material;
    const TextureDescription& image = scene.textures[metalness_image];
    const auto texel = [&](float coordinate, std::uint32_t size) {
        const float inside = image.repeats ? coordinate - std::floor(coordinate) : std::clamp(coordinate, 0.0f, 1.0f);
        return std::min(static_cast<std::uint32_t>(inside * static_cast<float>(size)), size - 1);
    };
    const std::size_t row = texel(1.0f - middle.y, image.height);
    const float value = metalness * image.texels[row * image.width + texel(middle.x, image.width)].z;
    return value >= kGltfHalf ? metal : material;
}

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
