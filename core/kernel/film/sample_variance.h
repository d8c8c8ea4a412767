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

/// Use of the samples of a pass.
enum class SampleUse : std::uint32_t {
    Film,      ///< added to the film
    Measured,  ///< added, and their variance measured
    Trial,     ///< measured alone: the film does not change
};

/// Pixels of a pass that leaves out some: one of every `step`, at a place within them that varies, and steps on with `phase`.
struct PixelSubset {
    std::uint32_t step = 1;
    std::uint32_t phase = 0;

    PL_HD std::uint32_t count(std::uint32_t pixels) const { return pixels / step; }
    PL_HD std::uint32_t pixel(std::uint32_t number) const {
        return number * step + (((number * 0x9e3779b9u) >> 16) + phase) % step;
    }
    PL_HD std::uint32_t number(std::uint32_t pixel) const { return pixel / step; }
};

/// Measures the variance of a sample that is about to come to a pixel. With the mean m of earlier samples, L (L - m) is an
/// unbiased estimate of the variance of an independent sample L. Samples of one half of the film are spread evenly, and so
/// depend on one another: m is the mean of the half that the pass does not belong to. Divided by m^2 it has a bias that vanishes with the
/// number of samples behind m: methods are compared against the same m. Pixels that see a lamp are left out: their
/// variance is the variance of emission, which no sampling of directions changes, see camera_emission.h.
PL_HD inline void measure_variance(const FilmPixel& pixel, Vec3f radiance, std::uint32_t pass, VarianceSums& sums) {
    const bool sees_lamp = pixel.emission.is_lit() || pixel.emission.varies != 0 || pixel.emission.at_border != 0;
    const bool has_both_halves = pixel.second_weight > 0 && pixel.weight > pixel.second_weight;
    if (!has_both_halves || sees_lamp || !is_valid_radiance(radiance)) return;
    const Vec3f mean = half_mean(pixel, !in_second_half(pass));
    sums.add(radiance * (radiance - mean), mean);
}

/// Puts the sample of a pass to its use. Returns false if it is invalid.
PL_HD inline bool use_sample(const FilmView& film, std::uint32_t pixel, Vec3f radiance, std::uint32_t pass,
                             SampleUse use, VarianceSums& sums) {
    if (use != SampleUse::Film) measure_variance(film.pixels[pixel], radiance, pass, sums);
    return use == SampleUse::Trial ? is_valid_radiance(radiance) : accumulate(film, pixel, radiance, pass);
}

}  // namespace pl
