// Adapters of Mitsuba: surfaces that change another one inside of them.
#pragma once

#include <optional>

#include "core/io/mitsuba/textures.h"

namespace pl {

/// The effects of all adapters around a surface, and that surface.
struct MitsubaAdapters {
    MitsubaObject inside{};
    MitsubaObject coat{};                   ///< `coating` or `roughcoating`, the outermost one; or nothing
    MitsubaObject image{};                  ///< one of the textures below; or nothing
    std::uint32_t normals = kNoTexture;     ///< of `normalmap`
    std::optional<MitsubaRelief> relief{};  ///< of `bumpmap`
    bool has_mask = false;
    float opacity = 1.0f;                  ///< of `mask`
    std::uint32_t opacities = kNoTexture;  ///< likewise, multiplies it
};

/// Effects that are left out are noted. Throws Error(Input) if there is none.
/// [Mitsuba 3 and 0.6, plugins]
MitsubaAdapters read_mitsuba_adapters(const MitsubaObject& bsdf, SceneDescription& scene);

}  // namespace pl
