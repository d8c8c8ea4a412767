// Noise without a reference, and error taken apart: by hand, and on noise whose size is known.
#include "core/measure/halves.h"

#include <random>

#include "core/base/error.h"
#include "tests/catch.hpp"

namespace pl::test {
namespace {

using Picture = std::vector<Vec3f>;

constexpr int kSide = 128;

/// Radiance `mean` with independent normal noise in every pixel, the same in all channels.
Picture noisy(double mean, double deviation, std::uint64_t seed) {
    std::mt19937_64 generator(seed);
    std::normal_distribution<double> normal(mean, deviation);
    Picture picture(kSide * kSide);
    for (Vec3f& pixel : picture) pixel = Vec3f(static_cast<float>(normal(generator)));
    return picture;
}

}  // namespace

TEST_CASE("noise of halves by hand") {
    const Picture a{Vec3f(1.0f), Vec3f(2.0f)};
    const Picture b{Vec3f(3.0f), Vec3f(2.0f)};
    const Noise noise = estimate_noise({a, b});
    CHECK_THAT(noise.mse, WithinRel((4.0 / 4.0 + 0.0) / 2.0, 1e-12));
    CHECK_THAT(noise.relmse, WithinRel((1.0 / 4.01) / 2.0, 1e-12));
    CHECK(noise.pixels == 2);
    CHECK_THROWS_AS(estimate_noise({a, Picture(3)}), Error);
}

TEST_CASE("halves tell the noise of their mean") {
    // 16384 pixels: the estimate has a relative deviation of sqrt(2 / 16384) = 1.1 %; 5.5 % are five of them.
    const Picture a = noisy(1.0, 0.2, 1);
    const Picture b = noisy(1.0, 0.2, 2);
    CHECK_THAT(estimate_noise({a, b}).mse, WithinRel(0.5 * 0.04, 0.055));
    const Picture mean = weighted_mean(a, 1.0, b, 1.0);
    CHECK_THAT(measure_error(mean, Picture(a.size(), Vec3f(1.0f))).mse, WithinRel(0.5 * 0.04, 0.055));
}

TEST_CASE("a bias of half a percent is found as bias, and noise alone is not taken for one") {
    // Noise of 10 % in each half leaves 0.1 / sqrt(2 * 16384) = 0.055 % on the mean: 0.5 % are nine of that.
    const double planted = 0.005;
    const Picture r1 = noisy(1.0, 0.01, 11), r2 = noisy(1.0, 0.01, 12);
    for (const double bias : {0.0, planted, -planted}) {
        const Picture a = noisy(1.0 + bias, 0.1, 21), b = noisy(1.0 + bias, 0.1, 22);
        const ErrorParts parts = take_apart({a, b}, {r1, r2}, kSide);
        CAPTURE(bias, parts.signed_bias.value, parts.signed_bias.error);
        CHECK(parts.pixels == kSide * kSide);
        CHECK(parts.signed_bias.error < 0.001);
        CHECK_THAT(parts.signed_bias.value, WithinAbs(bias, 5.0 * parts.signed_bias.error));
        CHECK((std::fabs(parts.signed_bias.value) > 5.0 * parts.signed_bias.error) == (bias != 0.0));
        // The variance is the same with bias and without: what is planted does not show up as noise.
        CHECK_THAT(parts.variance, WithinRel(0.5 * 0.01 / 1.01, 0.06));
        CHECK_THAT(parts.reference_noise, WithinRel(0.5 * 1e-4 / 1.01, 0.06));
        CHECK_THAT(parts.squared_bias.value, WithinAbs(bias * bias / 1.01, 5.0 * parts.squared_bias.error));
    }
}

TEST_CASE("the squared bias is seen where it exceeds the noise of its estimate") {
    const Picture r1 = noisy(1.0, 0.01, 31), r2 = noisy(1.0, 0.01, 32);
    // Its error is 0.01 / sqrt(16384) = 8e-5: a bias of 3 % is eleven of that, one of 0.5 % is a third.
    const ErrorParts large = take_apart({noisy(1.03, 0.1, 41), noisy(1.03, 0.1, 42)}, {r1, r2}, kSide);
    CHECK(large.squared_bias.is_seen());
    CHECK_THAT(large.error, WithinAbs(large.variance + large.squared_bias.value, 5e-4));
    const ErrorParts none = take_apart({noisy(1.0, 0.1, 43), noisy(1.0, 0.1, 44)}, {r1, r2}, kSide);
    CHECK(std::fabs(none.squared_bias.value) < 4.9 * none.squared_bias.error);
}

TEST_CASE("what cannot be taken apart") {
    const Picture four(4, Vec3f(1.0f));
    CHECK_THROWS_AS(take_apart({four, four}, {four, Picture(3)}, 2), Error);
    CHECK_THROWS_AS(take_apart({four, four}, {four, four}, 3), Error);
    CHECK_THROWS_AS(take_apart({four, four}, {four, four}, 0), Error);
    Picture broken = four;
    broken[2] = Vec3f(std::numeric_limits<float>::quiet_NaN());
    const ErrorParts parts = take_apart({four, broken}, {four, four}, 2);
    CHECK(parts.pixels == 3);
    CHECK(parts.invalid == 1);
    // One block says nothing about how much blocks differ.
    CHECK_FALSE(parts.signed_bias.is_seen());
}

}  // namespace pl::test
