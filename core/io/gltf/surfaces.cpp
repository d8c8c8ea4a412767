#include "core/io/gltf/surfaces.h"

#include <cmath>
#include <set>

#include <fmt/format.h>

#include "core/io/gltf/surface_reader.h"

namespace pl {

glm::vec2 UvMapping::apply(glm::vec2 uv) const {
    const glm::vec2 scaled = scale * uv;
    const float c = std::cos(rotation);
    const float s = std::sin(rotation);
    const glm::vec2 turned(c * scaled.x + s * scaled.y, c * scaled.y - s * scaled.x);
    return {turned.x + offset.x, 1.0f - (turned.y + offset.y)};
}

UvMapping read_uv_mapping(const GltfFile& file, const std::string& info) {
    constexpr std::uint64_t kMostSets = 255;
    const std::string transform = info + "/extensions/KHR_texture_transform";
    const std::uint64_t set = file.whole(info + "/texCoord", 0, 0, kMostSets);
    const auto pair = [&](const char* key, glm::vec2 standard) {
        const auto given = file.json().numbers(transform + key, 2);
        return given ? glm::vec2((*given)[0], (*given)[1]) : standard;
    };
    return {.set = static_cast<std::uint32_t>(file.whole(transform + "/texCoord", set, 0, kMostSets)),
            .offset = pair("/offset", glm::vec2(0.0f)),
            .scale = pair("/scale", glm::vec2(1.0f)),
            .rotation = file.json().number(transform + "/rotation").value_or(0.0f)};
}

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

std::uint32_t VertexOpacities::surface_with(std::uint32_t surface, const OpacityRange& range, const std::string& at) {
    const GltfSurface& known = surfaces_[surface];
    if (known.vertex_alpha == VertexAlpha::Ignored || range.least == 1.0f) return surface;
    if (known.vertex_alpha == VertexAlpha::Cut) {
        if (range.least >= known.least_alpha) return surface;
        if (range.most < known.least_alpha) return scaled(surface, 0.0f);
        file_.note("opacities of vertices on both sides of a cutoff are left out", at);
    } else if (range.least != range.most) {
        file_.note("opacities of vertices that differ within a primitive are left out", at);
    } else if (known.vertex_alpha == VertexAlpha::Scales || range.most == 0.0f) {
        return scaled(surface, range.most);
    } else {
        file_.note("opacities of vertices are left out where an image is cut off below half of its opacity", at);
    }
    return surface;
}

std::uint32_t VertexOpacities::scaled(std::uint32_t surface, float opacity) {
    const auto [known, is_new] = known_.try_emplace({surface, opacity}, static_cast<std::uint32_t>(surfaces_.size()));
    if (!is_new) return known->second;
    GltfSurface copy = surfaces_[surface];
    if (opacity == 0.0f) {
        copy.is_hidden = true;
    } else {
        MaterialDescription material = scene_.materials[copy.material];
        material.name = free_name(material.name, opacity);
        material.opacity *= opacity;
        copy.material = static_cast<std::uint32_t>(scene_.materials.size());
        scene_.materials.push_back(std::move(material));
    }
    surfaces_.push_back(copy);
    return known->second;
}

std::string VertexOpacities::free_name(const std::string& name, float opacity) {
    if (names_.empty())
        for (const MaterialDescription& material : scene_.materials) names_.insert(material.name);
    std::string free = fmt::format("{} (opacity {:.3g})", name, opacity);
    if (names_.contains(free)) free += fmt::format(" ({})", scene_.materials.size());
    names_.insert(free);
    return free;
}

}  // namespace pl
