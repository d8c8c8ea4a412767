// Metrics of a picture against a reference, on linear radiance before any tone mapping. The definitions are here and
// nowhere else; exports repeat kEpsilon with their numbers.
#pragma once

#include <cstddef>
#include <span>

#include "core/kernel/base/math.h"

namespace pl {

/// Keeps relative metrics finite where the reference is black. In relMSE it is added to the square, in the others to
/// the value.
inline constexpr double kEpsilon = 0.01;
/// Share of the pixels, the worst ones, that trimmed metrics leave out.
inline constexpr double kTrimmedShare = 0.001;

/// Means over channels and over all pixels that are finite in picture and reference. All are 0 if no pixel is.
struct Metrics {
    double mse = 0.0;                   ///< (x-r)^2
    double rmse = 0.0;                  ///< its root
    double relmse = 0.0;                ///< (x-r)^2 / (r^2 + kEpsilon)
    double mse_trimmed = 0.0;           ///< without the kTrimmedShare of pixels where it is largest
    double relmse_trimmed = 0.0;        ///< the same
    double mape = 0.0;                  ///< |x-r| / (|r| + kEpsilon)
    double smape = 0.0;                 ///< 2 |x-r| / (|x| + |r| + kEpsilon)
    double bias = 0.0;                  ///< luminance of x-r, with its sign
    double relative_bias = 0.0;         ///< the same over the mean luminance of the reference; 0 if that is 0
    double psnr_db = 0.0;               ///< 10 log10(1 / mse): peak 1, the display's white; infinite where mse is 0
    std::size_t pixels = 0;             ///< that are finite in both
    std::size_t invalid = 0;            ///< NaN or infinite in the picture: in none of the means
    std::size_t invalid_reference = 0;  ///< NaN or infinite in the reference alone
};

using Pixels = std::span<const Vec3f>;

/// A picture as two disjoint halves of its samples, each an unbiased estimate of the same mean. Passes of learning
/// methods may be split, too: each pass is unbiased given the passes before it, so the halves are uncorrelated.
struct PictureHalves {
    Pixels first;
    Pixels second;
    double first_weight = 1.0;  ///< of the samples in the first half, in any unit; both weights are positive
    double second_weight = 1.0;
};

/// Throws Error(Input) if the numbers of pixels differ. The number of threads does not change the result.
Metrics measure_error(Pixels picture, Pixels reference, int threads = 1);

/// The same against the halves of a converged picture, equally weighted: squares are products (x-r1)(x-r2), unbiased by the noise of the
/// reference and possibly negative near zero, which is not corrected; rmse is then 0 and psnr infinite. The other metrics use the mean of
/// the halves.
Metrics measure_error(Pixels picture, const PictureHalves& reference, int threads = 1);

inline double luminance_of(const Vec3d& radiance) {
    return 0.2126 * radiance.x + 0.7152 * radiance.y + 0.0722 * radiance.z;
}

/// Number of pixels that are NaN or infinite.
std::size_t count_invalid(Pixels picture);
/// Index of the first of them, or the number of pixels.
std::size_t first_invalid(Pixels picture);

}  // namespace pl
