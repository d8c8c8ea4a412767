// What two independent halves of a picture tell: its noise without any reference, and with a reference in two halves
// which part of the error is noise and which part stays however long one renders. Numbers of threads change no result.
#pragma once

#include <vector>

#include "core/measure/metrics.h"
#include "core/session/backend.h"

namespace pl {

/// A picture as two disjoint halves of its samples, each an unbiased estimate of the same mean. Passes of learning
/// methods may be split too: each pass is unbiased given the ones before, so they are uncorrelated.
struct PictureHalves {
    Pixels first;
    Pixels second;
    double first_weight = 1.0;  ///< samples in the first half, in any unit; positive, as the other one
    double second_weight = 1.0;
};

/// What a film was read as; both halves have to be there.
PictureHalves halves_of(const FilmHalves& halves);

/// Squared noise, plain and relative as in Metrics, of the weighted mean of both halves.
struct Noise {
    double mse = 0.0;
    double relmse = 0.0;  ///< over the square of the picture itself, since there is no reference
    std::size_t pixels = 0;
    std::size_t invalid = 0;  ///< not finite in a half
};

/// With shares p and q of the samples, pq (a-b)^2 has the variance of pa + qb as its mean; (a-b)^2 / 4 for equal halves.
/// Throws Error(Input) if sizes differ.
Noise estimate_noise(const PictureHalves& halves, int threads = 1);

/// A value and how far it may be off.
struct Estimate {
    double value = 0.0;
    double error = 0.0;  ///< standard error; infinite where too few blocks tell

    /// Two standard errors or more from zero.
    bool is_seen() const;
};

/// The squared error of a picture taken apart. All but `signed_bias` in units of Metrics::relmse.
struct ErrorParts {
    double error = 0.0;     ///< (x-r1)(x-r2): variance and bias together
    double variance = 0.0;  ///< pq (a-b)^2
    Estimate squared_bias;  ///< (a-r1)(b-r2): no noise enters twice, so all that is left is bias; may be negative
    Estimate signed_bias;   ///< luminance of x-r over the mean luminance of r
    double reference_noise = 0.0;  ///< (r1-r2)^2 / 4, of the mean of the halves
    std::size_t pixels = 0;
    std::size_t invalid = 0;  ///< not finite somewhere
};

/// Standard errors are those of means over blocks of kBlockSide x kBlockSide pixels, because neighboring pixels share
/// what was learned. For one run they are too small where all pixels share a table: the true ones need several seeds.
/// Throws Error(Input) if sizes differ or `width` does not divide them.
ErrorParts take_apart(const PictureHalves& picture, const ReferenceHalves& reference, int width, int threads = 1);
inline constexpr int kBlockSide = 16;

/// Pixelwise mean of two pictures of `first_weight` and `second_weight` samples each.
std::vector<Vec3f> weighted_mean(Pixels first, double first_weight, Pixels second, double second_weight);

}  // namespace pl
