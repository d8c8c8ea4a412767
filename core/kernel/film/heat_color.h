// The color map of heat maps. Display only.
#pragma once

#include <cstdint>

#include "core/kernel/base/math.h"

namespace pl {

/// sRGB, 8 bits.
struct ByteColor {
    std::uint8_t r = 0;
    std::uint8_t g = 0;
    std::uint8_t b = 0;

    PL_HD friend bool operator==(const ByteColor&, const ByteColor&) = default;
};

/// Intervals of the color map; colors are interpolated linearly.
inline constexpr int kHeatSteps = 16;

/// Color of a value in [0, 1], clamped; NaN gives the marker of invalid pixels. From dark violet over teal to light
/// yellow, perceptually about uniform: in CIELAB lightness rises linearly from 14 to 92, hue falls linearly from 308
/// to 100 degrees, chroma is the smoothed limit of the sRGB gamut.
PL_HD inline ByteColor heat_color(float share) {
    // Local, because device code cannot read namespace-scope arrays of the host.
    constexpr std::uint8_t kColors[kHeatSteps + 1][3] = {
        {43, 23, 81},    {32, 41, 96},    {18, 56, 107},   {3, 70, 115},    {4, 84, 121},   {2, 98, 129},
        {6, 112, 136},   {3, 126, 142},   {7, 140, 147},   {25, 155, 149},  {51, 169, 148}, {79, 183, 145},
        {109, 196, 139}, {141, 207, 132}, {175, 218, 126}, {211, 227, 122}, {248, 235, 122}};
    if (share != share) return {255, 0, 255};
    const float x = clamp_to(share, 0.0f, 1.0f) * static_cast<float>(kHeatSteps);
    const int step = min_of(static_cast<int>(x), kHeatSteps - 1);
    const float rest = x - static_cast<float>(step);
    const auto channel = [&](int i) {
        const auto low = static_cast<float>(kColors[step][i]);
        const auto high = static_cast<float>(kColors[step + 1][i]);
        return static_cast<std::uint8_t>(low + (high - low) * rest + 0.5f);
    };
    return {channel(0), channel(1), channel(2)};
}

}  // namespace pl
