// Blends of Mitsuba surfaces as chains of materials, each of which blends with the next.
#pragma once

#include <string>
#include <vector>

#include "core/io/mitsuba/surfaces.h"

namespace pl {

/// Weight of the second of two surfaces: a number times an image.
struct MitsubaWeight {
    float number = 0.5f;               ///< in [0, 1]
    std::uint32_t image = kNoTexture;  ///< first channel
    MitsubaObject texture{};           ///< of the image; or nothing
};

/// The weight by the number or texture of this name.
MitsubaWeight mitsuba_weight(const MitsubaObject& object, const std::string& name, float standard,
                             SceneDescription& scene);

/// Two chains of materials as one. Each material but the last has the share of those behind it, and the image of that share. `object` is
/// noted where they do not blend: then the heavier one is shown.
std::vector<MaterialDescription> blended_parts(const MitsubaObject& object, std::vector<MaterialDescription> first,
                                               std::vector<MaterialDescription> second, const MitsubaWeight& weight,
                                               SceneDescription& scene);

/// The surface of a `bsdf` element of the type blendbsdf, inside of `depth` others. [Mitsuba 3, blendbsdf]
MitsubaSurface mitsuba_blend(const MitsubaObject& blend, SceneDescription& scene, int depth);

}  // namespace pl
