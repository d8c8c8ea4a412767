// Blended materials: at each arrival at a surface one of its two materials is chosen at random, by their shares, and decides its BSDF.
#pragma once

#include <bit>

#include "core/kernel/base/hash.h"
#include "core/kernel/base/rng.h"
#include "core/kernel/scene/scene_view.h"

namespace pl {

/// Most choices in a row, where a chosen material blends itself.
inline constexpr std::uint32_t kMostBlends = 8;

/// A material at a point of a triangle.
struct MaterialPoint {
    std::uint32_t material;
    std::uint32_t primitive;
    std::uint32_t triangle;  ///< the primitive's, see triangle_of()
    Vec3f b;                 ///< barycentric weights
};

/// A number in [0, 1), uniform over arrivals: a function of the bits of a point and of the direction of arrival alone, so that all who
/// ask for the BSDF there, a replay of the path for one, decide alike. Independent of
/// number_of_hit(), by other words, and for each `choice` in a row.
PL_HD inline float number_of_choice(const MaterialPoint& point, Vec3f wo, std::uint32_t choice) {
    constexpr std::uint32_t kSalt = 0x626C656Eu;
    std::uint32_t hash = hash_word(kSalt + choice, point.primitive);
    hash = hash_word(hash, std::bit_cast<std::uint32_t>(point.b.y));
    hash = hash_word(hash, std::bit_cast<std::uint32_t>(point.b.z));
    for (int axis = 0; axis < 3; ++axis) hash = hash_word(hash, std::bit_cast<std::uint32_t>(wo[axis]));
    return to_unit_float(hash);
}

/// Share of the other material at a point.
PL_HD inline float share_at(const Textures& textures, const MaterialBlend& blend, const MaterialPoint& point) {
    if (blend.image == kNoImage) return blend.share;
    return blend.share * sample_image(textures, blend.image, uv_at(textures, point.triangle, point.b)).x;
}

/// Number of the material that a point of a surface with the material `point.material` shows towards wo. SceneView::blends must not be
/// empty.
PL_HOST_APART PL_HD inline std::uint32_t blended_material(const SceneView& scene, MaterialPoint point, Vec3f wo) {
    for (std::uint32_t choice = 0; choice < kMostBlends; ++choice) {
        const MaterialBlend& blend = scene.blends[point.material];
        if (blend.other == kNoBlend) break;
        if (number_of_choice(point, wo, choice) >= share_at(scene.textures, blend, point)) break;
        point.material = blend.other;
    }
    return point.material;
}

}  // namespace pl
