// The measurement of variances: unbiased, bounded, and without pixels that see lamps.
#include "core/kernel/film/sample_variance.h"

#include <random>
#include <vector>

#include "tests/support/catch.hpp"

using namespace pl;

namespace {

constexpr VarianceMeasure kPass{.is_any = true};

/// Measured with so many training samples a pixel.
VarianceMeasure with_training(std::int32_t samples) { return {.is_any = true, .training = samples}; }

double mean_of(const VarianceSums& sums) {
    return VarianceSums::units_of(sums.sum) / static_cast<double>(sums.samples);
}
double training_mean_of(const VarianceSums& sums) {
    return VarianceSums::units_of(sums.training_sum) / static_cast<double>(sums.samples);
}

FilmView view_of_film(std::vector<FilmPixel>& pixels) {
    return {{pixels.data(), static_cast<std::uint32_t>(pixels.size())}, static_cast<std::uint32_t>(pixels.size()), 1};
}

/// 0.2 or 0.6, as often.
template <class Random>
Vec3f either(Random& random) {
    return Vec3f{random() % 2 == 0 ? 0.2f : 0.6f};
}

}  // namespace

// The mean m of two samples of the other half is 0.2 or 0.6 in one case of four each, else 0.4; the mean of L (L - m) is 0.2 - 0.4 m. Seed
// 7, 200000 pixels: the standard error is 0.5 %; over the true squared mean of 0.16 the sum would be 0.24.
TEST_CASE("Sample variance: it is over the squared mean of the other half") {
    std::mt19937 random(7);
    std::vector<FilmPixel> pixels(200000);
    const FilmView film = view_of_film(pixels);
    VarianceSums sums;
    for (std::uint32_t i = 0; i < film.pixels.count; ++i) {
        for (std::uint32_t pass = 0; pass < 4; ++pass) accumulate(film, i, either(random), pass);
        CHECK(add_sample(film, i, either(random), 4, kPass, sums));
    }
    CHECK(sums.samples == film.pixels.count);
    CHECK(mean_of(sums) == Approx(0.25 * 0.12 / 0.05 + 0.5 * 0.04 / 0.17 - 0.25 * 0.04 / 0.37).epsilon(0.02));
}

// Samples of one half take turns between two values: the last one is that which the half lacks. The other half's mean m is one sample, 0.2
// or 0.6, and the mean of L (L - m) is 0.12 or -0.04. Measured by their own half, whose first sample is 0.8 - L, it would be 0.08 on the
// mean.
TEST_CASE("Sample variance: right though the samples of a half are spread evenly") {
    std::mt19937 random(6);
    for (const std::uint32_t pass : {2u, 3u}) {
        std::vector<FilmPixel> pixels(200000);
        const FilmView film = view_of_film(pixels);
        VarianceSums sums;
        for (std::uint32_t i = 0; i < film.pixels.count; ++i) {
            const Vec3f first = either(random);
            accumulate(film, i, first, pass - 2);
            accumulate(film, i, either(random), pass - 1);
            add_sample(film, i, Vec3f{0.8f} - first, pass, kPass, sums);
        }
        INFO("pass " << pass);
        CHECK(mean_of(sums) == Approx(0.5 * 0.12 / 0.05 - 0.5 * 0.04 / 0.37).epsilon(0.02));
    }
}

TEST_CASE("Sample variance: samples come to the film, and are measured if there is a block") {
    std::vector<FilmPixel> pixels(1);
    const FilmView film = view_of_film(pixels);
    for (std::uint32_t pass = 0; pass < 3; ++pass) accumulate(film, 0, Vec3f{1.0f}, pass);
    VarianceSums sums;
    CHECK(add_sample(film, 0, Vec3f{3.0f}, 3, {}, sums));
    CHECK(sums.samples == 0);
    CHECK(add_sample(film, 0, Vec3f{3.0f}, 5, kPass, sums));
    CHECK(mean_of(sums) == Approx(3.0 * 2.0 / 1.01));
    CHECK(pixels[0].weight == 5);
    CHECK_FALSE(add_sample(film, 0, Vec3f{kNan}, 3, kPass, sums));
    CHECK(pixels[0].invalid == 1);
    CHECK(sums.samples == 1);
}

TEST_CASE("Sample variance: pixels without samples in the other half, lamps and invalid samples are not measured") {
    std::vector<FilmPixel> pixels(1);
    const FilmView film = view_of_film(pixels);
    VarianceSums sums;
    for (const std::uint32_t pass : {0u, 2u}) add_sample(film, 0, Vec3f{1.0f}, pass, kPass, sums);
    CHECK(sums.samples == 0);
    measure_variance(film, 0, Vec3f{kInfinity}, 3, kPass, sums);
    pixels[0].emission = EmissionSeen::of(5.0f);
    measure_variance(film, 0, Vec3f{2.0f}, 3, kPass, sums);
    pixels[0].emission = EmissionSeen::of(0.0f);
    pixels[0].emission.at_border = 1;
    measure_variance(film, 0, Vec3f{2.0f}, 3, kPass, sums);
    CHECK(sums.samples == 0);
    CHECK(sums.sum == 0);
    pixels[0].emission.at_border = 0;
    measure_variance(film, 0, Vec3f{2.0f}, 3, kPass, sums);
    CHECK(sums.samples == 1);
}

// Training samples of variance 0.04 and later ones of 0.09 around the same mean, in blocks of two brightnesses, over the squared mean of the
// neighbors' training samples. Seed 8, 400000 pixels: the standard errors are below 0.4 %.
TEST_CASE("Sample variance: training samples are measured by later ones, over the mean of a pixel's neighbors") {
    std::mt19937 random(8);
    for (const std::uint32_t training : {1u, 2u}) {
        std::vector<FilmPixel> pixels(400'000);
        const FilmView film = view_of_film(pixels);
        // Every other block is brighter by this.
        const auto extra = [](std::uint32_t i) { return Vec3f{i / 4 % 2 == 0 ? 0.0f : 0.2f}; };
        for (std::uint32_t i = 0; i < film.pixels.count; ++i)
            for (std::uint32_t pass = 0; pass < training; ++pass)
                accumulate(film, i, either(random) + extra(i), 2 * pass + 1);
        VarianceSums sums;
        for (std::uint32_t i = 0; i < film.pixels.count; ++i)
            add_sample(film, i, Vec3f{random() % 2 == 0 ? 0.1f : 0.7f} + extra(i), 8, with_training(training), sums);
        CHECK(sums.samples == film.pixels.count);
        // The mean of the quotient 1 / (m^2 + 0.01) over the means of 3 * training samples of both kinds of blocks.
        double over = 0.0;
        const int count = static_cast<int>(3 * training);
        for (int high = 0; high <= count; ++high) {
            const double probability = std::tgamma(count + 1) /
                                       (std::tgamma(high + 1) * std::tgamma(count - high + 1)) / std::pow(2.0, count);
            for (const double more : {0.0, 0.2}) {
                const double mean = 0.2 + 0.4 * high / count + more;
                over += 0.5 * probability / (mean * mean + 0.01);
            }
        }
        INFO(training << " training samples");
        CHECK(mean_of(sums) == Approx(0.09 * over).epsilon(0.02));
        CHECK(training_mean_of(sums) == Approx(0.04 * over).epsilon(0.02));
    }
}

// Ten pixels: two blocks, and a last one of two.
TEST_CASE(
    "Sample variance: the mean around a pixel is that of its neighbors in the second half alone, whatever comes to "
    "the first") {
    std::vector<FilmPixel> pixels(10);
    FilmView film = view_of_film(pixels);
    for (std::uint32_t i = 0; i < 10; ++i) accumulate(film, i, Vec3f{static_cast<float>(i)}, 1);
    film.weight = 3;
    for (const std::uint32_t pass : {0u, 2u})
        for (std::uint32_t i = 0; i < 10; ++i) {
            const double own = i;
            const double mean = i < 4 ? (6.0 - own) / 3.0 : i < 8 ? (22.0 - own) / 3.0 : 17.0 - own;
            CHECK(mean_around(film, i) == Vec3f{static_cast<float>(mean)});
            VarianceSums sums;
            add_sample(film, i, Vec3f{2.0f}, pass, with_training(1), sums);
            CHECK(mean_of(sums) == Approx(2.0 * (2.0 - own) / (mean * mean + 0.01)));
            CHECK(training_mean_of(sums) == Approx(own * (own - 2.0) / (mean * mean + 0.01)));
            const double unit = 0x1p-14;  // of squares and products, which are rounded towards zero
            CHECK(std::fabs(VarianceSums::product_units_of(sums.squares) - mean_of(sums) * mean_of(sums)) <= unit);
            CHECK(std::fabs(VarianceSums::product_units_of(sums.training_squares) -
                            training_mean_of(sums) * training_mean_of(sums)) <= unit);
            CHECK(std::fabs(VarianceSums::product_units_of(sums.products) - mean_of(sums) * training_mean_of(sums)) <=
                  unit);
        }
    // A pixel that sees a lamp is not measured, but its neighbors are.
    pixels[9].emission = EmissionSeen::of(5.0f);
    VarianceSums sums;
    for (std::uint32_t i = 0; i < 10; ++i) measure_variance(film, i, Vec3f{2.0f}, 4, with_training(1), sums);
    CHECK(sums.samples == 9);
    // A pixel without neighbors is not measured.
    std::vector<FilmPixel> five(5);
    const FilmView odd = view_of_film(five);
    for (std::uint32_t i = 0; i < 5; ++i) accumulate(odd, i, Vec3f{1.0f}, 1);
    VarianceSums four;
    for (std::uint32_t i = 0; i < 5; ++i) measure_variance(odd, i, Vec3f{2.0f}, 4, with_training(1), four);
    CHECK(four.samples == 4);
}

TEST_CASE("Sample variance: one path of any radiance adds a bounded share") {
    std::vector<FilmPixel> pixels(2);
    const FilmView film = view_of_film(pixels);
    for (const float earlier : {0.0f, 1.0f, 1e30f, 3e38f}) {
        pixels[0] = pixels[1] = {};
        for (std::uint32_t pass = 0; pass < 3; ++pass)
            for (std::uint32_t i = 0; i < 2; ++i) accumulate(film, i, Vec3f{earlier}, pass);
        for (const float radiance : {0.0f, 1e-30f, 5.0f, 1e10f, 3e38f})
            for (const VarianceMeasure measure : {kPass, with_training(2)}) {
                VarianceSums sums;
                measure_variance(film, 0, Vec3f{radiance}, 4, measure, sums);
                INFO(earlier << ", " << radiance << ": " << mean_of(sums));
                CHECK(sums.samples == 1);
                CHECK(std::fabs(mean_of(sums)) <= VarianceSums::kMost);
                CHECK(std::fabs(training_mean_of(sums)) <= VarianceSums::kMost);
                for (const std::uint64_t product : {sums.squares, sums.training_squares, sums.products})
                    CHECK(std::fabs(VarianceSums::product_units_of(product)) <=
                          VarianceSums::kMost * VarianceSums::kMost);
            }
    }
}
