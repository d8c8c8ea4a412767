// Noise without a reference: by hand, and on noise of known size.
#include "core/measure/noise.h"

#include <cmath>
#include <limits>
#include <random>

#include "core/base/error.h"
#include "tests/core/measure/noisy_picture.h"
#include "tests/support/catch.hpp"

namespace pl::test {
namespace {

using Picture = std::vector<Vec3f>;

/// Radiance 1 from samples of which each finds light with a chance of `chance`.
Picture sparse(int samples, double chance, std::uint64_t seed) {
    std::mt19937_64 generator(seed);
    std::binomial_distribution<int> hits(samples, chance);
    Picture picture(kNoisySide * kNoisySide);
    for (Vec3f& pixel : picture) pixel = Vec3f(static_cast<float>(hits(generator) / (samples * chance)));
    return picture;
}

}  // namespace

TEST_CASE("noise of halves by hand") {
    const Picture a{Vec3f(1.0f), Vec3f(2.0f)};
    const Picture b{Vec3f(3.0f), Vec3f(2.0f)};
    const Noise noise = estimate_noise({a, b}, 2);
    CHECK_THAT(noise.mse, WithinRel((4.0 / 4.0 + 0.0) / 2.0, 1e-12));
    CHECK_THAT(noise.relmse, WithinRel((1.0 / 4.01) / 2.0, 1e-12));
    CHECK(noise.pixels == 2);
    // A third of the samples and two: 2/9 of the square, and the mean of 1 and 3 is 7/3.
    const Noise uneven = estimate_noise({.first = a, .second = b, .first_weight = 1.0, .second_weight = 2.0}, 2);
    const double around = (7.0 / 3.0 + 2.0) / 2.0;
    CHECK_THAT(uneven.mse, WithinRel(4.0 * 2.0 / 9.0 / 2.0, 1e-12));
    CHECK_THAT(uneven.relmse, WithinRel(4.0 * 2.0 / 9.0 / (around * around + 0.01) / 2.0, 1e-12));
    CHECK_THROWS_AS(estimate_noise({a, Picture(3)}, 1), Error);
    CHECK_THROWS_AS(estimate_noise({a, b}, 3), Error);
    CHECK(estimate_noise({Picture{}, Picture{}}, 1).pixels == 0);
}

// 200 experiments, seeds 1000 to 1399: the spread of their results has a relative standard error of 5 %, and the mean of
// their own estimates of it, from 64 blocks, one of 1 %.
TEST_CASE("noise says how far it may be off") {
    double sum = 0.0, squares = 0.0, said = 0.0;
    constexpr int kExperiments = 200;
    for (std::uint64_t i = 0; i < kExperiments; ++i) {
        const Noise noise =
            estimate_noise({noisy(1.0, 0.2, 1000 + 2 * i), noisy(1.0, 0.2, 1001 + 2 * i)}, kNoisySide);
        sum += noise.relmse;
        squares += noise.relmse * noise.relmse;
        said += noise.relmse_off / kExperiments;
    }
    const double spread = std::sqrt((squares - sum * sum / kExperiments) / (kExperiments - 1));
    CHECK_THAT(said, WithinRel(spread, 0.2));
    CHECK(std::isinf(estimate_noise({Picture{Vec3f(1.0f)}, Picture{Vec3f(2.0f)}}, 1).relmse_off));
}

TEST_CASE("the window ends at the border and leaves out pixels that are not finite") {
    // One bright pixel in the corner of a picture of 11 x 7: seen from up to 4 pixels away, divided by the window there.
    constexpr int kWidth = 11, kHeight = 7;
    Picture a(kWidth * kHeight, Vec3f(0.0f));
    a[0] = Vec3f(8.0f);
    a[1] = Vec3f(std::numeric_limits<float>::quiet_NaN());
    Picture b = a;
    const auto relative = [&](int x, int y) {
        Picture c = a;
        c[static_cast<std::size_t>(y * kWidth + x)] += Vec3f(0.002f);  // the only pixel with noise
        return estimate_noise({b, c}, kWidth).relmse * (kWidth * kHeight - 1) / 1e-6;
    };
    CHECK(estimate_noise({a, b}, kWidth).invalid == 1);
    const auto expected = [](double pixels) { return 1.0 / (64.0 / (pixels * pixels) + 0.01); };
    CHECK_THAT(relative(0, 0), WithinRel(expected(5 * 5 - 1), 1e-2));
    CHECK_THAT(relative(4, 0), WithinRel(expected(9 * 5 - 1), 1e-2));
    CHECK_THAT(relative(4, 4), WithinRel(expected(9 * 7 - 1), 1e-2));
    CHECK_THAT(relative(5, 0), WithinRel(100.0, 1e-2));
    CHECK_THAT(relative(4, 5), WithinRel(100.0, 1e-2));
    CHECK_THAT(relative(10, 6), WithinRel(100.0, 1e-2));
}

TEST_CASE("halves give the noise of their mean") {
    // 16384 pixels: the estimate has a relative deviation of sqrt(2 / 16384) = 1.1 %; 5.5 % are five of them.
    const Picture a = noisy(1.0, 0.2, 1);
    const Picture b = noisy(1.0, 0.2, 2);
    CHECK_THAT(estimate_noise({a, b}, kNoisySide).mse, WithinRel(0.5 * 0.04, 0.055));
    const Picture mean = weighted_mean(a, 1.0, b, 1.0);
    CHECK_THAT(measure_error(mean, Picture(a.size(), Vec3f(1.0f))).mse, WithinRel(0.5 * 0.04, 0.055));
}

TEST_CASE("a picture that has hardly found any light is as noisy as it is") {
    // Two to 64 samples per half that find light in one of 20 cases: relMSE is (20 - 1) / (2 n) / 1.01.
    for (const int samples : {2, 8, 64}) {
        const Picture a = sparse(samples, 0.05, 3), b = sparse(samples, 0.05, 4);
        const double truth = 19.0 / (2.0 * samples) / 1.01;
        CAPTURE(samples, truth);
        // 81 pixels in a window: their mean is off by sqrt(19 / (2 n 81)), 0.34 to 0.06, of which the square is off by
        // twice that; and pixels divided by less weigh more.
        const double relmse = estimate_noise({a, b}, kNoisySide).relmse;
        CHECK(relmse > 0.8 * truth);
        CHECK(relmse < 1.4 * truth);
    }
}

TEST_CASE("threads change no bit of noise, error and parts") {
    const Picture a = noisy(1.0, 0.3, 5), b = noisy(1.0, 0.3, 6), r1 = noisy(1.0, 0.01, 7), r2 = noisy(1.0, 0.01, 8);
    const Noise noise = estimate_noise({a, b}, kNoisySide);
    const Metrics metrics = measure_error(a, PictureHalves{r1, r2});
    const ErrorParts parts = take_apart({a, b}, {r1, r2}, kNoisySide);
    for (const int threads : {2, 3, 64}) {
        CHECK(estimate_noise({a, b}, kNoisySide, threads).relmse == noise.relmse);
        CHECK(measure_error(a, PictureHalves{r1, r2}, threads).relmse_trimmed == metrics.relmse_trimmed);
        CHECK(take_apart({a, b}, {r1, r2}, kNoisySide, threads).squared_bias.value == parts.squared_bias.value);
        CHECK(take_apart({a, b}, {r1, r2}, kNoisySide, threads).variance == parts.variance);
    }
}

}  // namespace pl::test
