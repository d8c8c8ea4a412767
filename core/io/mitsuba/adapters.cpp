#include "core/io/mitsuba/adapters.h"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>

#include "core/io/line_reader.h"
#include "core/io/mitsuba/surfaces.h"
#include "core/kernel/base/math.h"

namespace pl {
namespace {

bool is_adapter(const std::string& type) {
    constexpr std::array<std::string_view, 6> kAdapters = {"twosided",  "mask",    "bumpmap",
                                                           "normalmap", "coating", "roughcoating"};
    return std::find(kAdapters.begin(), kAdapters.end(), type) != kAdapters.end();
}

/// The image among the properties of an adapter, or nothing.
MitsubaObject image_of(const MitsubaFile& file, const MitsubaObject& adapter) {
    for (const MitsubaObject& child : adapter.children()) {
        const MitsubaObject target = mitsuba_target(file, child);
        if (target.element() == "texture" && target.type() == "bitmap") return target;
    }
    return {};
}

/// Multiplies the opacity by that of an adapter of the type mask.
void read_mask(const MitsubaFile& file, const MitsubaObject& mask, SceneDescription& scene,
               MitsubaAdapters& adapters) {
    adapters.has_mask = true;
    const MitsubaObject texture = mitsuba_target(file, mask.property("opacity"));
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

void read_normals(const MitsubaFile& file, const MitsubaObject& adapter, SceneDescription& scene,
                  MitsubaAdapters& adapters) {
    const MitsubaObject image = image_of(file, adapter);
    if (!image) {
        adapter.note(fmt::format("the texture of {} is no image, and is left out", in_quotes(adapter.type())));
        return;
    }
    adapters.image = image;
    if (adapter.type() == "bumpmap")
        adapters.relief = {image, static_cast<double>(adapter.number("scale").value_or(1.0f))};
    else
        adapters.normals = mitsuba_image(image, TextureContent::Normal, scene).value_or(kNoTexture);
}

void read_adapter(const MitsubaFile& file, const MitsubaObject& adapter, SceneDescription& scene,
                  MitsubaAdapters& adapters) {
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
        read_mask(file, adapter, scene, adapters);
    else
        read_normals(file, adapter, scene, adapters);
}

/// The surface inside of an adapter.
MitsubaObject inside_of(const MitsubaFile& file, const MitsubaObject& adapter) {
    for (const MitsubaObject& child : adapter.children()) {
        const MitsubaObject target = mitsuba_target(file, child);
        if (target.element() == "bsdf") return target;
    }
    return {};
}

}  // namespace

MitsubaAdapters read_mitsuba_adapters(const MitsubaFile& file, const MitsubaObject& bsdf, SceneDescription& scene) {
    constexpr int kMostAdapters = 16;
    MitsubaAdapters adapters{.inside = bsdf};
    for (int depth = 0; is_adapter(mitsuba_name(adapters.inside.type())); ++depth) {
        const MitsubaObject adapter = adapters.inside;
        read_adapter(file, adapter, scene, adapters);
        adapters.inside = inside_of(file, adapter);
        if (!adapters.inside || depth > kMostAdapters) {
            adapter.fail(fmt::format("{}: expected a surface inside, got {}", adapter.type(),
                                     adapters.inside ? "a circle" : "none"));
        }
    }
    return adapters;
}

}  // namespace pl
