#include "core/io/gltf/vertex_opacity.h"

#include <fmt/format.h>

namespace pl {

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
