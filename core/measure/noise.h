// The noise of a picture without any reference.
#pragma once

#include "core/measure/halves.h"

namespace pl {

/// Squared noise, plain and relative as in Metrics, of the weighted mean of both halves.
struct Noise {
    double mse = 0.0;
    double relmse = 0.0;      ///< over the squared mean of the pixels around, in place of a reference
    double relmse_off = 0.0;  ///< standard error of that over blocks, as of ErrorParts; infinite below two blocks
    std::size_t pixels = 0;
    std::size_t invalid = 0;  ///< not finite in a half
};

/// Pixels to each side whose mean stands for what a pixel will be. The pixel alone would not do: the few that have found
/// light would be divided by their own excess, and the many that have not count for nothing, so that a picture with a
/// true relMSE of 11 seemed to have one of 0.02 (Cornell box, 2 samples per pixel; 7.8 with the mean, and within 6 % of
/// the truth from 8 samples on). Where dark pixels lie beside much brighter ones they count too little.
inline constexpr int kNoiseWindow = 4;

/// With shares p and q of the samples, pq (a-b)^2 has the variance of pa + qb as its mean; (a-b)^2 / 4 for equal halves.
/// Throws Error(Input) if sizes differ or `width` does not divide them. The number of threads does not change the result.
Noise estimate_noise(const PictureHalves& halves, int width, int threads = 1);

}  // namespace pl
