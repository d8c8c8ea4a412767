// The variance of the paths of a pass, summed while their samples come to the film: from it a session decides whether guiding
// pays.
#pragma once

#include "core/kernel/film/film_view.h"

namespace pl {

/// Sums over pixels of the relative variance of one sample, the mean of its channels: the integrand of a relMSE. Signed fixed point in
/// two's complement: the same for every order of the samples.
struct VarianceSums {
    std::uint64_t sum = 0;           ///< in steps; biased, see measure_variance()
    std::uint64_t training_sum = 0;  ///< of the training samples that these were measured against
    std::uint64_t samples = 0;       ///< measured ones
    /// Sums of squares and of the products of both, for the error of these sums.
    std::uint64_t squares = 0;
    std::uint64_t training_squares = 0;
    std::uint64_t products = 0;

    /// Contributions of one sample are clamped here, so that a single path decides nothing: far above 1, because rare bright paths are
    /// most of the variance that guiding can take away (docs/notebook/2026-11-29-one-ratio.md).
    static constexpr float kMost = 1024.0f;
    static constexpr double kSteps = 0x1p24;         ///< per unit: 2^28 samples of the largest size do not overflow
    static constexpr double kProductSteps = 0x1p14;  ///< of squares and products: as many
    /// Added to the squared mean, as in relMSE (core/measure).
    static constexpr float kLeastSquare = 0.01f;

    /// Calls fn(total, sum) for every sum.
    template <class Totals, class Sums, class Fn>
    PL_HD static void each(Totals& totals, Sums& sums, Fn&& fn) {
        fn(totals.sum, sums.sum);
        fn(totals.training_sum, sums.training_sum);
        fn(totals.samples, sums.samples);
        fn(totals.squares, sums.squares);
        fn(totals.training_squares, sums.training_squares);
        fn(totals.products, sums.products);
    }

    /// Adds the variances of a measured sample and of its training samples, in steps.
    PL_HD void add(std::int64_t own, std::int64_t training) {
        ++samples;
        sum += static_cast<std::uint64_t>(own);
        training_sum += static_cast<std::uint64_t>(training);
        squares += product_of(own, own);
        training_squares += product_of(training, training);
        products += product_of(own, training);
    }

    /// Of all measured samples: relative variances, their squares and products.
    static double units_of(std::uint64_t steps) { return signed_of(steps) / kSteps; }
    static double product_units_of(std::uint64_t steps) { return signed_of(steps) / kProductSteps; }

    /// The steps of a variance, by channels, over mean^2 + kLeastSquare.
    PL_HD static std::int64_t steps_of(Vec3f variance, Vec3f mean) {
        const Vec3f over = variance / (mean * mean + Vec3f{kLeastSquare});
        const float value = (over.x + over.y + over.z) * kThird;
        // The largest one for the difference of two infinities, too.
        const float bounded = value < kMost ? max_of(value, -kMost) : kMost;
        return static_cast<std::int64_t>(static_cast<double>(bounded) * kSteps);
    }

private:
    static constexpr float kThird = 1.0f / 3.0f;

    static double signed_of(std::uint64_t steps) { return static_cast<double>(static_cast<std::int64_t>(steps)); }
    PL_HD static std::uint64_t product_of(std::int64_t a, std::int64_t b) {
        const double product = static_cast<double>(a) * static_cast<double>(b) * (kProductSteps / (kSteps * kSteps));
        return static_cast<std::uint64_t>(static_cast<std::int64_t>(product));
    }
};

/// Whether the samples of a pass are measured, against the half of the film that the pass does not belong to: see measure_variance().
struct VarianceMeasure {
    bool is_any = false;
    std::int32_t training =
        0;  ///< samples of a pixel in the second half, if these are training samples and measured, too; else 0

    /// Neighbors in a row of memory, which begin at multiples of their number: training samples of a pixel are few, so that the
    /// mean radiance is known from them.
    static constexpr std::uint32_t kBlock = 4;
};

/// The mean of the second half of a pixel's neighbors in its block, without the pixel itself; NaN if they have no samples.
PL_HD inline Vec3f mean_around(const FilmView& film, std::uint32_t pixel) {
    const std::uint32_t begin = pixel - pixel % VarianceMeasure::kBlock;
    const std::uint32_t end = min_of(begin + VarianceMeasure::kBlock, film.pixels.count);
    Vec3d sum{0.0};
    std::uint64_t weight = 0;
    for (std::uint32_t i = begin; i < end; ++i) {
        if (i == pixel) continue;
        sum += film.pixels[i].second_sum;
        weight += film.pixels[i].second_weight;
    }
    return weight == 0 ? Vec3f{kNan} : Vec3f{sum * (1.0 / static_cast<double>(weight))};
}

/// Measures the variance of a sample L that is about to come to a pixel. With the mean m of earlier independent samples, L (L - m) is an
/// unbiased estimate of its variance, and n m (m - L) of the variance of one of the n training samples behind m; a bright one of these is
/// clamped as it would be alone, as n m (n m - n L) / n. Samples of one half of the film are spread evenly, and so depend on one another: m
/// is the mean of the half that the pass does not belong to. Divided by a squared mean, both have a bias that vanishes with the number of
/// samples behind that mean: methods are compared over the same one, m or, for training samples, the mean of the pixel's neighbors. Pixels
/// that see a lamp are left out: their variance is the variance of emission, which no sampling of directions changes, see
/// camera_emission.h. Other threads may add samples of the same pass to neighbors: with training samples the pass has to be of the first
/// half, so that what is read of them stays.
PL_HD inline void measure_variance(const FilmView& film, std::uint32_t pixel, Vec3f radiance, std::uint32_t pass,
                                   VarianceMeasure measure, VarianceSums& sums) {
    const bool has_training = measure.training > 0;
    PL_ASSERT(!has_training || !in_second_half(pass));
    const FilmPixel& p = film.pixels[pixel];
    const bool sees_lamp = p.emission.is_lit() || p.emission.varies != 0 || p.emission.at_border != 0;
    if (sees_lamp || !is_valid_radiance(radiance)) return;
    const Vec3f mean = half_mean(p, !in_second_half(pass));
    const Vec3f over = has_training ? mean_around(film, pixel) : mean;
    if (mean.x != mean.x || over.x != over.x) return;
    const Vec3f total = static_cast<float>(measure.training) * mean;
    const Vec3f expected = static_cast<float>(measure.training) * radiance;
    sums.add(VarianceSums::steps_of(radiance * (radiance - mean), over),
             has_training ? VarianceSums::steps_of(total * (total - expected), over) / measure.training : 0);
}

/// Adds the sample of a pass, and measures what is to be measured. Returns false if the sample is invalid.
PL_HD inline bool add_sample(const FilmView& film, std::uint32_t pixel, Vec3f radiance, std::uint32_t pass,
                             VarianceMeasure measure, VarianceSums& sums) {
    if (measure.is_any) measure_variance(film, pixel, radiance, pass, measure, sums);
    return accumulate(film, pixel, radiance, pass);
}

}  // namespace pl
