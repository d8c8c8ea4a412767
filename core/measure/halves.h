// Noise and bias from two independent halves of a picture and of its reference. The number of threads changes no
// result.
#pragma once

#include <initializer_list>
#include <vector>

#include "core/measure/metrics.h"
#include "core/session/backend.h"

namespace pl {

/// The halves of a film reading, which must both have samples.
PictureHalves halves_of(const FilmHalves& halves);

/// Share of each half in the weight of all samples.
struct HalfShares {
    double first;
    double second;

    explicit HalfShares(const PictureHalves& halves)
        : first(halves.first_weight / (halves.first_weight + halves.second_weight)), second(1.0 - first) {}
    /// Value of a pixel from the values of its halves.
    Vec3d mean(const Vec3d& a, const Vec3d& b) const { return first * a + second * b; }
    /// Estimate of the variance of mean(), unbiased if the variances of the halves are as 1 / weight: (a-b)^2 / 4 for
    /// equal halves.
    Vec3d variance(const Vec3d& a, const Vec3d& b) const { return first * second * (a - b) * (a - b); }
};

/// Denominator of relative squared errors, by channel.
inline Vec3d relative_weight(const Vec3d& scale) { return Vec3d(1.0) / (scale * scale + Vec3d(kEpsilon)); }
inline double channel_mean(const Vec3d& v) { return (v.x + v.y + v.z) / 3.0; }

/// Throw Error(Input).
void require_same_sizes(std::initializer_list<Pixels> pictures);
void require_full_rows(std::size_t pixels, int width);

/// A value with its standard error.
struct Estimate {
    double value = 0.0;
    double error = 0.0;  ///< standard error; infinite with too few blocks

    /// At least two standard errors from zero.
    bool is_seen() const;
};

/// Decomposition of the squared error of a picture. All but `signed_bias` in units of Metrics::relmse.
struct ErrorParts {
    double error = 0.0;      ///< (x-r1)(x-r2): variance and bias together
    double error_off = 0.0;  ///< standard error of that
    double variance = 0.0;   ///< HalfShares::variance()
    Estimate
        squared_bias;  ///< (a-r1)(b-r2): the noises of all factors are independent, so the mean is the squared bias; may be negative
    Estimate signed_bias;          ///< luminance of x-r over the mean luminance of r
    double reference_noise = 0.0;  ///< (r1-r2)^2 / 4, of the mean of the halves
    std::size_t pixels = 0;
    std::size_t invalid = 0;  ///< pixels that are not finite in a half of the picture or of the reference
};

/// Standard errors are taken from means over blocks of kBlockSide x kBlockSide pixels, because neighboring pixels
/// share learned radiance. For one run they are too small where many pixels share a volume: the true ones need
/// several seeds. Throws Error(Input) if sizes differ or `width` does not divide them.
ErrorParts take_apart(const PictureHalves& picture, const PictureHalves& reference, int width, int threads = 1);
inline constexpr int kBlockSide = 16;

/// Pixelwise mean of two pictures of `first_weight` and `second_weight` samples each.
std::vector<Vec3f> weighted_mean(Pixels first, double first_weight, Pixels second, double second_weight);

}  // namespace pl
