#include "core/io/mitsuba/blends.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "core/io/line_reader.h"
#include "core/kernel/base/math.h"
#include "core/kernel/shading/blends.h"
#include "core/scene/surface_info.h"

namespace pl {
namespace {

bool is_adapter(const std::string& type) {
    constexpr std::array<std::string_view, 6> kAdapters = {"twosided",  "mask",    "bumpmap",
                                                           "normalmap", "coating", "roughcoating"};
    return std::find(kAdapters.begin(), kAdapters.end(), type) != kAdapters.end();
}

/// The image among the properties of an adapter, or nothing.
MitsubaObject image_of(const MitsubaObject& adapter) {
    for (const MitsubaObject& texture : adapter.parts("texture"))
        if (texture.type() == "bitmap") return texture;
    return {};
}

/// Multiplies the opacity by the opacity of an adapter of the type mask.
void read_mask(const MitsubaObject& mask, SceneDescription& scene, MitsubaAdapters& adapters) {
    adapters.has_mask = true;
    const MitsubaObject texture = mask.property("opacity");
    if (texture.element() != "texture") {
        const glm::vec3 color = mask.color("opacity").value_or(glm::vec3(0.5f));
        adapters.opacity *= std::clamp(luminance(color), 0.0f, 1.0f);
    } else if (texture.type() != "bitmap" || adapters.opacities != kNoTexture) {
        mask.note("opacities that are no image, and further ones inside of others, are left out");
    } else {
        adapters.opacities = mitsuba_opacities(texture, scene);
        adapters.image = texture;
    }
}

void read_normals(const MitsubaObject& adapter, SceneDescription& scene, MitsubaAdapters& adapters) {
    const MitsubaObject image = image_of(adapter);
    if (!image) {
        adapter.leave_out(fmt::format("the texture of {} is no image, and is left out", in_quotes(adapter.type())));
        return;
    }
    adapters.image = image;
    if (adapter.type() == "bumpmap")
        adapters.relief = {image, static_cast<double>(adapter.number("scale").value_or(1.0f))};
    else
        adapters.normals = mitsuba_image(image, TextureContent::Normal, scene).value_or(kNoTexture);
}

void read_adapter(const MitsubaObject& adapter, SceneDescription& scene, MitsubaAdapters& adapters) {
    const std::string type = adapter.type();
    if (type == "twosided") return;
    if (type == "coating" || type == "roughcoating") {
        if (adapters.coat)
            adapter.note("coats under coats are left out");
        else
            adapters.coat = adapter;
        return;
    }
    if (adapters.coat) adapter.note("masks and reliefs under a coat are those of the coat, too");
    if (type == "mask")
        read_mask(adapter, scene, adapters);
    else
        read_normals(adapter, scene, adapters);
}

}  // namespace

MitsubaAdapters read_mitsuba_adapters(const MitsubaObject& bsdf, SceneDescription& scene) {
    constexpr int kMostAdapters = 16;
    MitsubaAdapters adapters{.inside = bsdf};
    for (int depth = 0; is_adapter(mitsuba_name(adapters.inside.type())); ++depth) {
        const MitsubaObject adapter = adapters.inside;
        read_adapter(adapter, scene, adapters);
        adapters.inside = adapter.part("bsdf");
        if (!adapters.inside || depth > kMostAdapters) {
            adapter.fail(fmt::format("{}: expected a surface inside, got {}", adapter.type(),
                                     adapters.inside ? "a circle" : "none"));
        }
    }
    return adapters;
}

namespace {

using Parts = std::vector<MaterialDescription>;

float mean_of(const MitsubaWeight& weight, const SceneDescription& scene) {
    if (weight.image == kNoTexture) return weight.number;
    const std::vector<glm::vec4>& texels = scene.textures[weight.image].texels;
    double sum = 0.0;
    for (const glm::vec4& texel : texels) sum += static_cast<double>(texel.x);
    return weight.number * static_cast<float>(sum / static_cast<double>(texels.size()));
}

/// 1 - weight.
MitsubaWeight opposite(const MitsubaWeight& weight, SceneDescription& scene) {
    if (weight.image == kNoTexture) return {.number = 1.0f - weight.number};
    TextureDescription image = scene.textures[weight.image];
    for (glm::vec4& texel : image.texels) texel.x = 1.0f - weight.number * texel.x;
    scene.textures.push_back(std::move(image));
    return {.number = 1.0f, .image = static_cast<std::uint32_t>(scene.textures.size() - 1)};
}

Parts linked(MaterialDescription first, const MitsubaWeight& weight, Parts rest) {
    first.blend.share = weight.number;
    first.textures.blend = weight.image;
    rest.insert(rest.begin(), std::move(first));
    return rest;
}

/// If neither is a single material, the weights are numbers.
Parts joined(Parts first, Parts second, const MitsubaWeight& weight, SceneDescription& scene) {
    if (first.size() == 1) return linked(std::move(first.front()), weight, std::move(second));
    if (second.size() == 1) return linked(std::move(second.front()), opposite(weight, scene), std::move(first));
    MaterialDescription front = std::move(first.front());
    first.erase(first.begin());
    const float behind = 1.0f - (1.0f - weight.number) * (1.0f - front.blend.share);
    const MitsubaWeight of_second{.number = behind > 0.0f ? std::min(weight.number / behind, 1.0f) : 0.0f};
    return linked(std::move(front), {.number = behind},
                  joined(std::move(first), std::move(second), of_second, scene));
}

/// The reason why two chains do not blend, or none.
std::string obstacle(const Parts& first, const Parts& second, const MitsubaWeight& weight) {
    const auto is_solid_glass = [](const MaterialDescription& material) { return has_inside(material.kind); };
    if (std::ranges::any_of(first, is_solid_glass) || std::ranges::any_of(second, is_solid_glass))
        return "blends with glass are shown as the component of the larger share";
    const auto has_image = [](const MaterialDescription& material) { return material.textures.blend != kNoTexture; };
    if (first.size() > 1 && second.size() > 1 &&
        (weight.image != kNoTexture || std::ranges::any_of(first, has_image)))
        return "blends of two blends by an image are shown as the component of the larger share";
    if (first.size() + second.size() > kMostBlends + 1)
        return fmt::format("blends of more than {} surfaces are shown as the component of the larger share",
                           kMostBlends + 1);
    return "";
}

bool has_adapters(const MitsubaSurface& surface) {
    return surface.material.textures.normal != kNoTexture || surface.material.may_have_holes() ||
           surface.relief.has_value();
}

void copy_adapters(const MaterialDescription& from, MaterialDescription& to) {
    to.textures.normal = from.textures.normal;
    to.normal_green = from.normal_green;
    to.textures.opacity = from.textures.opacity;
    to.opacity = from.opacity;
    to.opacity_rule = from.opacity_rule;
}

/// The chain of a surface, without the effects of adapters around it.
Parts parts_of(const MitsubaSurface& surface) {
    Parts parts{surface.material};
    copy_adapters({}, parts.front());
    parts.insert(parts.end(), surface.others.begin(), surface.others.end());
    return parts;
}

/// The two surfaces inside of a blend.
std::vector<MitsubaSurface> surfaces_inside(const MitsubaObject& blend, SceneDescription& scene, int depth) {
    std::vector<MitsubaSurface> inside;
    for (const MitsubaObject& bsdf : blend.parts("bsdf")) inside.push_back(mitsuba_surface(bsdf, scene, depth + 1));
    if (inside.size() != 2) blend.fail(fmt::format("blendbsdf: expected two surfaces inside, got {}", inside.size()));
    return inside;
}

}  // namespace

MitsubaWeight mitsuba_weight(const MitsubaObject& object, const std::string& name, float standard,
                             SceneDescription& scene) {
    const MitsubaObject texture = object.property(name);
    if (texture.element() != "texture")
        return {.number = std::clamp(object.number(name).value_or(standard), 0.0f, 1.0f)};
    const std::uint32_t image = mitsuba_shares(texture, scene);
    if (image != kNoTexture) return {.number = 1.0f, .image = image, .texture = texture};
    texture.note(fmt::format("weights that are no image are shown as {}", standard));
    return {.number = standard};
}

Parts blended_parts(const MitsubaObject& object, Parts first, Parts second, const MitsubaWeight& weight,
                    SceneDescription& scene) {
    const float mean = mean_of(weight, scene);
    if (weight.image == kNoTexture && (mean == 0.0f || mean == 1.0f)) return mean == 0.0f ? first : second;
    const std::string reason = obstacle(first, second, weight);
    if (reason.empty()) return joined(std::move(first), std::move(second), weight, scene);
    object.note(reason);
    return mean > 0.5f ? second : first;
}

MitsubaSurface mitsuba_blend(const MitsubaObject& blend, SceneDescription& scene, int depth) {
    if (depth >= static_cast<int>(kMostBlends))
        blend.fail(fmt::format("blendbsdf: expected at most {} blends inside of each other, got more, or a circle",
                               kMostBlends));
    const std::vector<MitsubaSurface> inside = surfaces_inside(blend, scene, depth);
    const MitsubaWeight weight = mitsuba_weight(blend, "weight", 0.5f, scene);
    if (has_adapters(inside[0]) || has_adapters(inside[1]))
        blend.note("masks and reliefs of one of two blended surfaces are those of the first, for both");
    Parts parts = blended_parts(blend, parts_of(inside[0]), parts_of(inside[1]), weight, scene);
    MitsubaSurface surface{.material = std::move(parts.front()),
                           .image = inside[0].image,
                           .relief = inside[0].relief,
                           .shows_vertex_colors = inside[0].shows_vertex_colors || inside[1].shows_vertex_colors};
    copy_adapters(inside[0].material, surface.material);
    surface.is_inside_out =
        surface.material.kind == SurfaceKind::Dielectric && (inside[0].is_inside_out || inside[1].is_inside_out);
    surface.others.assign(parts.begin() + 1, parts.end());
    for (const MitsubaObject& image : {inside[1].image, weight.texture}) share_mitsuba_uv(image, surface);
    return surface;
}

}  // namespace pl
