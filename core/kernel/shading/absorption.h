// Absorption inside of glass: the law of Beer and Lambert.
#pragma once

#include <cstdint>

#include "core/kernel/base/math.h"

namespace pl {

/// Outside of all glass that absorbs. Else the medium of a point is the number of the material of the glass around it.
inline constexpr std::uint32_t kNoMedium = 0xffffffffu;

/// Optical depth from which on nothing is left.
inline constexpr float kOpaqueDepth = kMostDecay;

/// Share of light that is left behind a distance; infinite ones are allowed. `absorption`: share that is absorbed per length, at
/// least 0.   [Beer 1852]
PL_HD inline float transmittance(float absorption, float distance) {
    return absorption > 0.0f ? decay_of(absorption * distance) : 1.0f;
}
PL_HD inline Vec3f transmittance(Vec3f absorption, float distance) {
    return {transmittance(absorption.x, distance), transmittance(absorption.y, distance),
            transmittance(absorption.z, distance)};
}

}  // namespace pl
