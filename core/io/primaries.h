// Colors by primaries other than the primaries of sRGB.
#pragma once

#include <glm/glm.hpp>

#include "core/io/image.h"

namespace pl {

/// Chromaticities x and y [CIE 1931] of a color space: its three colors, and equal parts of them.
struct Primaries {
    glm::dvec2 red, green, blue, white;
};

/// [IEC 61966-2-1]
inline constexpr Primaries kSrgbPrimaries{{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, {0.3127, 0.3290}};

/// Converts linear colors of these primaries to sRGB, with a note; white stays white. Colors beyond sRGB get negative
/// parts. Primaries as near to sRGB's as the primaries of Radiance count as sRGB's. Primaries that are all 0 count as
/// none: Photoshop writes them.
void convert_to_srgb(const Primaries& from, const LinearSettings& settings, LinearImage& image);

}  // namespace pl
