#include "core/fields/same_placement.h"

#include <algorithm>

namespace pl {
namespace {

constexpr SurfaceLobes kDiffuse{};
constexpr MaterialImages kNoImages{};
constexpr MaterialOpacity kOpaque{};
constexpr MaterialBlend kPure{};

bool same_images(const MaterialImages& a, const MaterialImages& b) {
    return a.albedo == b.albedo && a.roughness == b.roughness && a.emission == b.emission;
}

bool same_opacity(const MaterialOpacity& a, const MaterialOpacity& b) {
    return a.image == b.image && a.factor == b.factor && a.blends == b.blends;
}

bool same_blend(const MaterialBlend& a, const MaterialBlend& b) {
    return a.other == b.other && a.share == b.share && a.image == b.image;
}

/// The properties of a material that the walks of a placement read.
struct Looks {
    const Material& material;
    const SurfaceLobes& lobes;
    const MaterialImages& images;
    const MaterialOpacity& opacity;
    const MaterialBlend& blend;

    Looks(const HostScene& scene, std::size_t index)
        : material(scene.materials[index]), lobes(scene.lobes.empty() ? kDiffuse : scene.lobes[index]),
          images(scene.material_images.empty() ? kNoImages : scene.material_images[index]),
          opacity(scene.opacities.empty() ? kOpaque : scene.opacities[index]),
          blend(scene.blends.empty() ? kPure : scene.blends[index]) {}

    /// Opaque and diffuse without images: the directions of a walk depend on neither color nor brightness, unless the
    /// albedo is 0.
    bool is_plain() const {
        return lobes.kind == SurfaceKind::Diffuse && same_images(images, kNoImages) && same_opacity(opacity, kOpaque);
    }
};

bool same_lobes(const SurfaceLobes& a, const SurfaceLobes& b) {
    return a.kind == b.kind && a.roughness == b.roughness && a.ior == b.ior && a.specular == b.specular &&
           a.transmission == b.transmission;
}

bool same_walks(const Looks& a, const Looks& b) {
    if (a.material.reflects() != b.material.reflects() ||
        a.material.two_sided_emission != b.material.two_sided_emission || !same_blend(a.blend, b.blend))
        return false;
    if (a.is_plain() && b.is_plain()) return true;
    return a.material.albedo == b.material.albedo && same_lobes(a.lobes, b.lobes) &&
           same_images(a.images, b.images) && same_opacity(a.opacity, b.opacity);
}

bool same_light(const Light& a, const Light& b) {
    return a.primitive == b.primitive && a.cumulative_probability == b.cumulative_probability;
}

}  // namespace

bool same_placement(const HostScene& before, const HostScene& after) {
    if (!std::ranges::equal(before.lights, after.lights, same_light)) return false;
    for (std::size_t i = 0; i < before.materials.size(); ++i)
        if (!same_walks(Looks(before, i), Looks(after, i))) return false;
    return true;
}

}  // namespace pl
