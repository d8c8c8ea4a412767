// The variance of the paths of a pass, summed while their samples come to the film: from it a session decides whether guiding
// pays.
#pragma once

#include "core/kernel/film/film_view.h"

namespace pl {

/// Sums over pixels of the relative variance of one sample, the mean of its channels: the integrand of a relMSE. Signed fixed point in
/// two's complement: the same for every order of the samples.
struct VarianceSums {
    std::uint64_t sum = 0;      ///< in steps; biased, see measure_variance()
    std::uint64_t samples = 0;  ///< measured ones

    /// Contributions of one sample are clamped here, so that a single path decides nothing: far above 1, because rare bright paths are
    /// most of the variance that guiding can take away (docs/notebook/2026-11-29-one-ratio.md).
    static constexpr float kMost = 1024.0f;
    static constexpr double kSteps = 0x1p24;  ///< per unit: 2^28 samples of the largest size do not overflow
    /// Added to the squared mean, as in relMSE (core/measure).
    static constexpr float kLeastSquare = 0.01f;

    VarianceSums& operator+=(const VarianceSums& other) {
        sum += other.sum;
        samples += other.samples;
        return *this;
    }

    /// The mean relative variance of a measured sample; 0 if none was measured.
    double mean() const {
        if (samples == 0) return 0.0;
        return static_cast<double>(static_cast<std::int64_t>(sum)) / (kSteps * static_cast<double>(samples));
    }

    /// Adds the variance of one sample, by channels, over mean^2 + kLeastSquare.
    PL_HD void add(Vec3f variance, Vec3f mean) {
        const Vec3f over = variance / (mean * mean + Vec3f{kLeastSquare});
        sum += steps_of((over.x + over.y + over.z) * kThird);
        ++samples;
    }

private:
    static constexpr float kThird = 1.0f / 3.0f;

    /// The largest one for the difference of two infinities, too.
    PL_HD static std::uint64_t steps_of(float value) {
        const float bounded = value < kMost ? max_of(value, -kMost) : kMost;
        return static_cast<std::uint64_t>(static_cast<std::int64_t>(static_cast<double>(bounded) * kSteps));
    }
};

/// Pixels whose earlier samples a sample is measured against: neighbors in a row of memory, which begin at multiples of their number.
struct MeanBlock {
    std::uint32_t pixels = 0;  ///< 0: samples are not measured

    static constexpr std::uint32_t kMostPixels = 4;

    PL_HD bool is_measured() const { return pixels > 0; }
};

/// Mean of the half of a block's samples that a pass does not belong to; NaN if there are none. Other
/// threads may add samples of the same pass to the block meanwhile: with several pixels the pass has to be of the first half, so that the
/// sums read here stay as they are.
PL_HD inline Vec3f mean_behind(const FilmView& film, std::uint32_t pixel, std::uint32_t pass, MeanBlock block) {
    const std::uint32_t begin = pixel - pixel % block.pixels;
    const std::uint32_t end = min_of(begin + block.pixels, film.pixels.count);
    PL_ASSERT(block.pixels == 1 || !in_second_half(pass));
    Vec3d sum{0.0};
    std::uint64_t weight = 0;
    for (std::uint32_t i = begin; i < end; ++i) {
        const FilmPixel& p = film.pixels[i];
        sum += in_second_half(pass) ? p.sum - p.second_sum : p.second_sum;
        weight += in_second_half(pass) ? p.weight - p.second_weight : p.second_weight;
    }
    return weight == 0 ? Vec3f{kNan} : Vec3f{sum * (1.0 / static_cast<double>(weight))};
}

/// Measures the variance of a sample that is about to come to a pixel. With the mean m of earlier samples, L (L - m) is an
/// unbiased estimate of the variance of an independent sample L; where m is the mean of a block of pixels, the mean over the block also
/// holds the variance of their means. Samples of one half of the film are spread evenly, and so
/// depend on one another: m is the mean of the half that the pass does not belong to. Divided by m^2 it has a bias that vanishes with the
/// number of samples behind m: methods are compared against the same m. Pixels that see a lamp are left out: their
/// variance is the variance of emission, which no sampling of directions changes, see camera_emission.h.
PL_HD inline void measure_variance(const FilmView& film, std::uint32_t pixel, Vec3f radiance, std::uint32_t pass,
                                   MeanBlock block, VarianceSums& sums) {
    const EmissionSeen& emission = film.pixels[pixel].emission;
    const bool sees_lamp = emission.is_lit() || emission.varies != 0 || emission.at_border != 0;
    if (sees_lamp || !is_valid_radiance(radiance)) return;
    const Vec3f mean = mean_behind(film, pixel, pass, block);
    if (mean.x == mean.x) sums.add(radiance * (radiance - mean), mean);
}

/// Adds the sample of a pass, and measures its variance if there is a block. Returns false if the sample is invalid.
PL_HD inline bool add_sample(const FilmView& film, std::uint32_t pixel, Vec3f radiance, std::uint32_t pass,
                             MeanBlock block, VarianceSums& sums) {
    if (block.is_measured()) measure_variance(film, pixel, radiance, pass, block, sums);
    return accumulate(film, pixel, radiance, pass);
}

}  // namespace pl
