#include "core/io/mitsuba/adapters.h"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>

#include "core/io/line_reader.h"
#include "core/kernel/base/math.h"

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

/// Multiplies the opacity by that of an adapter of the type mask.
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

}  // namespace pl
