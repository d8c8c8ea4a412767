// Pictures of one radiance with noise that is known.
#pragma once

#include <random>
#include <vector>

#include "core/kernel/base/math.h"

namespace pl::test {

inline constexpr int kNoisySide = 128;

/// Radiance `mean` with independent normal noise in every pixel, the same in all channels.
inline std::vector<Vec3f> noisy(double mean, double deviation, std::uint64_t seed) {
    std::mt19937_64 generator(seed);
    std::normal_distribution<double> normal(mean, deviation);
    std::vector<Vec3f> picture(kNoisySide * kNoisySide);
    for (Vec3f& pixel : picture) pixel = Vec3f(static_cast<float>(normal(generator)));
    return picture;
}

}  // namespace pl::test
