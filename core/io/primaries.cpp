#include "core/io/primaries.h"

#include <algorithm>
#include <cmath>

namespace pl {
namespace {

/// Any color of a chromaticity: XYZ of X + Y + Z = 1.
glm::dvec3 xyz_of(const glm::dvec2& chromaticity) {
    return {chromaticity.x, chromaticity.y, 1.0 - chromaticity.x - chromaticity.y};
}

/// Its Y is 1.
glm::dvec3 white_of(const Primaries& space) { return xyz_of(space.white) / space.white.y; }

/// From RGB to XYZ.
glm::dmat3 to_xyz(const Primaries& space) {
    const glm::dmat3 colors(xyz_of(space.red), xyz_of(space.green), xyz_of(space.blue));
    const glm::dvec3 parts = glm::inverse(colors) * white_of(space);
    return {parts.x * colors[0], parts.y * colors[1], parts.z * colors[2]};
}

/// From XYZ under one white to XYZ under another. [Bradford; ICC.1:2022, annex E]
glm::dmat3 adaptation(const glm::dvec3& from, const glm::dvec3& to) {
    const glm::dmat3 cones{{0.8951, -0.7502, 0.0389}, {0.2664, 1.7135, -0.0685}, {-0.1614, 0.0367, 1.0296}};
    const glm::dvec3 factor = (cones * to) / (cones * from);
    const glm::dmat3 scaled{factor * cones[0], factor * cones[1], factor * cones[2]};
    return glm::inverse(cones) * scaled;
}

/// The largest distance of corresponding chromaticities.
double distance(const Primaries& a, const Primaries& b) {
    return std::max({glm::length(a.red - b.red), glm::length(a.green - b.green), glm::length(a.blue - b.blue),
                     glm::length(a.white - b.white)});
}

}  // namespace

void convert_to_srgb(const Primaries& from, const LinearSettings& settings, LinearImage& image) {
    constexpr double kSame = 0.025;
    constexpr Primaries kNone{};
    if (distance(from, kSrgbPrimaries) < kSame || distance(from, kNone) == 0.0) return;
    const glm::dmat3 adapted = adaptation(white_of(from), white_of(kSrgbPrimaries)) * to_xyz(from);
    const glm::mat3 matrix(glm::inverse(to_xyz(kSrgbPrimaries)) * adapted);
    constexpr float kMostFactor = 100.0f;
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) {
            if (std::abs(matrix[column][row]) < kMostFactor) continue;
            settings.note("its primaries are those of no colors: counted as those of sRGB");
            return;
        }
    }
    settings.note("its primaries are not those of sRGB: converted");
    for (glm::vec3& pixel : image.pixels) pixel = matrix * pixel;
}

}  // namespace pl
