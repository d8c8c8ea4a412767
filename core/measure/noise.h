// The noise of a picture, estimated without a reference.
#pragma once

#include "core/measure/halves.h"

namespace pl {

/// Squared noise, plain and relative as in Metrics, of the weighted mean of both halves.
struct Noise {
    double mse = 0.0;
    double relmse = 0.0;      ///< relative to the squared mean of the surrounding pixels, in place of a reference
    double relmse_off = 0.0;  ///< standard error of relmse over blocks, as in ErrorParts; infinite below two blocks
    std::size_t pixels = 0;
    std::size_t invalid = 0;  ///< not finite in a half
};

/// Radius in pixels of the window whose mean estimates the converged value of a pixel. The pixel alone would not do:
/// the few that have found light would be divided by their own excess, and the many that have not would count for
/// nothing, so that a picture with a true relMSE of 11 seemed to have 0.02 (Cornell box, 2 samples per pixel; 7.8
/// with the mean, and within 6 % of the truth from 8 samples on). Dark pixels beside much brighter ones count too
/// little.
inline constexpr int kNoiseWindow = 4;

/// With shares p and q of the samples, pq (a-b)^2 has the variance of pa + qb as its mean; (a-b)^2 / 4 for equal halves.
/// Throws Error(Input) if sizes differ or `width` does not divide them. The number of threads does not change the result.
Noise estimate_noise(const PictureHalves& halves, int width, int threads = 1);

}  // namespace pl
