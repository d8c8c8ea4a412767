#include "core/scene/anisotropy.h"

#include <algorithm>
#include <cmath>

namespace pl {

MaterialAnisotropy pack_anisotropy(float anisotropy, float rotation_deg) {
    constexpr double kDegree = 3.14159265358979323846 / 180.0;
    const double ratio = 1.0 - static_cast<double>(anisotropy);
    const double along = 1.0 / std::sqrt(ratio);
    const double across = std::sqrt(ratio);
    // Isotropic facets of this width reflect as much in the mean over directions: a fit, good to 0.005 where it is at most 1, the end of
    // the table (tests/core/kernel/shading/anisotropy_test.cpp).
    const double width = 0.75 * std::sqrt(0.5 * (along * along + across * across)) + 0.25 * 0.5 * (along + across);
    const double angle = kDegree * static_cast<double>(rotation_deg);
    return {.stretch = static_cast<float>(along),
            .ratio = static_cast<float>(ratio),
            .table_stretch = static_cast<float>(std::sqrt(width)),
            .cosine = static_cast<float>(std::cos(angle)),
            .sine = static_cast<float>(std::sin(angle))};
}

bool set_widths(MaterialDescription& material, float along_u, float along_v) {
    const float larger = std::max(along_u, along_v);
    const float smaller = std::min(along_u, along_v);
    const float least = larger * (1.0f - kMostAnisotropy);
    material.roughness = std::sqrt(std::clamp(std::sqrt(larger * std::max(smaller, least)), 0.0f, 1.0f));
    material.anisotropy = larger > 0.0f ? std::min(1.0f - smaller / larger, kMostAnisotropy) : 0.0f;
    material.rotation_deg = along_v > along_u ? 90.0f : 0.0f;
    return smaller >= least;
}

}  // namespace pl
