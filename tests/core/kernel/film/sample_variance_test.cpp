// The measurement of variances: unbiased, bounded, and without pixels that see lamps.
#include "core/kernel/film/sample_variance.h"

#include <random>
#include <vector>

#include "tests/support/catch.hpp"

using namespace pl;

namespace {

constexpr MeanBlock kPixel{1};

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
        CHECK(add_sample(film, i, either(random), 4, kPixel, sums));
    }
    CHECK(sums.samples == film.pixels.count);
    CHECK(sums.mean() == Approx(0.25 * 0.12 / 0.05 + 0.5 * 0.04 / 0.17 - 0.25 * 0.04 / 0.37).epsilon(0.02));
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
            add_sample(film, i, Vec3f{0.8f} - first, pass, kPixel, sums);
        }
        INFO("pass " << pass);
        CHECK(sums.mean() == Approx(0.5 * 0.12 / 0.05 - 0.5 * 0.04 / 0.37).epsilon(0.02));
    }
}

TEST_CASE("Sample variance: samples come to the film, and are measured if there is a block") {
    std::vector<FilmPixel> pixels(1);
    const FilmView film = view_of_film(pixels);
    for (std::uint32_t pass = 0; pass < 3; ++pass) accumulate(film, 0, Vec3f{1.0f}, pass);
    VarianceSums sums;
    CHECK(add_sample(film, 0, Vec3f{3.0f}, 3, {}, sums));
    CHECK(sums.samples == 0);
    CHECK(add_sample(film, 0, Vec3f{3.0f}, 5, kPixel, sums));
    CHECK(sums.mean() == Approx(3.0 * 2.0 / 1.01));
    CHECK(pixels[0].weight == 5);
    CHECK_FALSE(add_sample(film, 0, Vec3f{kNan}, 3, kPixel, sums));
    CHECK(pixels[0].invalid == 1);
    CHECK(sums.samples == 1);
}

TEST_CASE("Sample variance: pixels without samples in the other half, lamps and invalid samples are not measured") {
    std::vector<FilmPixel> pixels(1);
    const FilmView film = view_of_film(pixels);
    VarianceSums sums;
    for (const std::uint32_t pass : {0u, 2u}) add_sample(film, 0, Vec3f{1.0f}, pass, kPixel, sums);
    CHECK(sums.samples == 0);
    measure_variance(film, 0, Vec3f{kInfinity}, 3, kPixel, sums);
    pixels[0].emission = EmissionSeen::of(5.0f);
    measure_variance(film, 0, Vec3f{2.0f}, 3, kPixel, sums);
    pixels[0].emission = EmissionSeen::of(0.0f);
    pixels[0].emission.at_border = 1;
    measure_variance(film, 0, Vec3f{2.0f}, 3, kPixel, sums);
    CHECK(sums.samples == 0);
    CHECK(sums.mean() == 0.0);
    pixels[0].emission.at_border = 0;
    measure_variance(film, 0, Vec3f{2.0f}, 3, kPixel, sums);
    CHECK(sums.samples == 1);
}

// Ten pixels: two blocks, and a last one of two.
TEST_CASE("Sample variance: the mean of a block is that of its samples in the second half alone, whatever comes to "
          "the first") {
    std::vector<FilmPixel> pixels(10);
    FilmView film = view_of_film(pixels);
    for (std::uint32_t i = 0; i < 10; ++i) accumulate(film, i, Vec3f{static_cast<float>(i)}, 1);
    film.weight = 3;
    for (const std::uint32_t pass : {0u, 2u})
        for (std::uint32_t i = 0; i < 10; ++i) {
            const float mean = i < 4 ? 1.5f : i < 8 ? 5.5f : 8.5f;
            CHECK(mean_behind(film, i, pass, {4}) == Vec3f{mean});
            VarianceSums sums;
            add_sample(film, i, Vec3f{2.0f}, pass, {4}, sums);
            CHECK(sums.mean() == Approx(2.0 * (2.0 - mean) / (mean * mean + 0.01)));
        }
    // A pixel that sees a lamp is not measured, but its neighbors are.
    pixels[9].emission = EmissionSeen::of(5.0f);
    VarianceSums sums;
    for (std::uint32_t i = 0; i < 10; ++i) measure_variance(film, i, Vec3f{2.0f}, 4, {4}, sums);
    CHECK(sums.samples == 9);
}

TEST_CASE("Sample variance: one path of any radiance adds a bounded share") {
    std::vector<FilmPixel> pixels(1);
    const FilmView film = view_of_film(pixels);
    for (const float earlier : {0.0f, 1.0f, 1e30f, 3e38f}) {
        pixels[0] = {};
        for (std::uint32_t pass = 0; pass < 3; ++pass) accumulate(film, 0, Vec3f{earlier}, pass);
        for (const float radiance : {0.0f, 1e-30f, 5.0f, 1e10f, 3e38f}) {
            VarianceSums sums;
            measure_variance(film, 0, Vec3f{radiance}, 3, kPixel, sums);
            INFO(earlier << ", " << radiance << ": " << sums.mean());
            CHECK(sums.samples == 1);
            CHECK(std::fabs(sums.mean()) <= VarianceSums::kMost);
        }
    }
}
