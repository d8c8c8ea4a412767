// Surfaces around surfaces: adapters of one, blends of two.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/io/mitsuba/surfaces.h"
#include "core/io/mitsuba/textures.h"

namespace pl {

// Adapters of Mitsuba: surfaces that change another one inside of them.

/// The effects of all adapters around a surface, and that surface.
struct MitsubaAdapters {
    MitsubaObject inside{};
    MitsubaObject coat{};                   ///< `coating` or `roughcoating`, the outermost one; or nothing
    MitsubaObject image{};                  ///< one of the textures below; or nothing
    std::uint32_t normals = kNoTexture;     ///< of `normalmap`
    std::optional<MitsubaRelief> relief{};  ///< of `bumpmap`
    bool has_mask = false;
    float opacity = 1.0f;                  ///< of `mask`
    std::uint32_t opacities = kNoTexture;  ///< of `mask`; multiplies `opacity`
};

/// Effects that are left out are noted. Throws Error(Input) if there is none.
/// [Mitsuba 3 and 0.6, plugins]
MitsubaAdapters read_mitsuba_adapters(const MitsubaObject& bsdf, SceneDescription& scene);

// Blends of Mitsuba surfaces as chains of materials, each of which blends with the next.

/// Weight of the second of two surfaces: a number times an image.
struct MitsubaWeight {
    float number = 0.5f;               ///< in [0, 1]
    std::uint32_t image = kNoTexture;  ///< first channel
    MitsubaObject texture{};           ///< of the image; or nothing
};

/// The weight by the number or texture of this name.
MitsubaWeight mitsuba_weight(const MitsubaObject& object, const std::string& name, float standard,
                             SceneDescription& scene);

/// Two chains of materials as one. Each material but the last has the share of the materials behind it, and the image
/// of that share. `object` is noted where they do not blend: then the heavier one is shown.
std::vector<MaterialDescription> blended_parts(const MitsubaObject& object, std::vector<MaterialDescription> first,
                                               std::vector<MaterialDescription> second, const MitsubaWeight& weight,
                                               SceneDescription& scene);

/// The surface of a `bsdf` element of the type blendbsdf, inside of `depth` others. [Mitsuba 3, blendbsdf]
MitsubaSurface mitsuba_blend(const MitsubaObject& blend, SceneDescription& scene, int depth);

}  // namespace pl
