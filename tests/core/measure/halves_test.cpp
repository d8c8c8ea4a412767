// Error taken apart, on noise whose size is known.
#include "core/measure/halves.h"

#include <cmath>

#include "core/base/error.h"
#include "tests/core/measure/noisy_picture.h"
#include "tests/support/catch.hpp"

namespace pl::test {
namespace {

using Picture = std::vector<Vec3f>;

}  // namespace

// As for noise: 200 experiments, seeds 2000 to 2399, against a reference without noise.
TEST_CASE("the error says how far it may be off") {
    const Picture truth(kNoisySide * kNoisySide, Vec3f(1.0f));
    double sum = 0.0, squares = 0.0, said = 0.0;
    constexpr int kExperiments = 200;
    for (std::uint64_t i = 0; i < kExperiments; ++i) {
        const Picture a = noisy(1.0, 0.2, 2000 + 2 * i), b = noisy(1.0, 0.2, 2001 + 2 * i);
        const ErrorParts parts = take_apart({a, b}, {truth, truth}, kNoisySide);
        sum += parts.error;
        squares += parts.error * parts.error;
        said += parts.error_off / kExperiments;
    }
    const double spread = std::sqrt((squares - sum * sum / kExperiments) / (kExperiments - 1));
    CHECK_THAT(said, WithinRel(spread, 0.2));
}

TEST_CASE("halves of unlike length weigh as they are long") {
    // 16384 pixels; a third and two thirds of the samples, so variances of 0.03 and 0.015 make one of 0.01.
    const Picture a = noisy(1.0, std::sqrt(0.03), 51), b = noisy(1.0, std::sqrt(0.015), 52);
    const Picture truth(a.size(), Vec3f(1.0f));
    const ErrorParts parts =
        take_apart({.first = a, .second = b, .first_weight = 1.0, .second_weight = 2.0}, {truth, truth}, kNoisySide);
    CHECK_THAT(parts.variance, WithinRel(0.01 / 1.01, 0.055));
    CHECK_THAT(parts.error, WithinRel(measure_error(weighted_mean(a, 1.0, b, 2.0), truth).relmse, 1e-5));
}

TEST_CASE("a bias of half a percent is found as bias, and noise alone is not taken for one") {
    // Noise of 10 % in each half leaves 0.1 / sqrt(2 * 16384) = 0.055 % on the mean: 0.5 % are nine of that.
    const double planted = 0.005;
    const Picture r1 = noisy(1.0, 0.01, 11), r2 = noisy(1.0, 0.01, 12);
    for (const double bias : {0.0, planted, -planted}) {
        const Picture a = noisy(1.0 + bias, 0.1, 21), b = noisy(1.0 + bias, 0.1, 22);
        const ErrorParts parts = take_apart({a, b}, {r1, r2}, kNoisySide);
        CAPTURE(bias, parts.signed_bias.value, parts.signed_bias.error);
        CHECK(parts.pixels == kNoisySide * kNoisySide);
        CHECK(parts.signed_bias.error < 0.001);
        CHECK_THAT(parts.signed_bias.value, WithinAbs(bias, 5.0 * parts.signed_bias.error));
        CHECK((std::fabs(parts.signed_bias.value) > 5.0 * parts.signed_bias.error) == (bias != 0.0));
        // The variance is the same with and without bias: the planted bias does not show up as noise.
        CHECK_THAT(parts.variance, WithinRel(0.5 * 0.01 / 1.01, 0.06));
        CHECK_THAT(parts.reference_noise, WithinRel(0.5 * 1e-4 / 1.01, 0.06));
        CHECK_THAT(parts.squared_bias.value, WithinAbs(bias * bias / 1.01, 5.0 * parts.squared_bias.error));
    }
}

TEST_CASE("the squared bias is seen where it exceeds the noise of its estimate") {
    const Picture r1 = noisy(1.0, 0.01, 31), r2 = noisy(1.0, 0.01, 32);
    // Its error is 0.01 / sqrt(16384) = 8e-5: a bias of 3 % is eleven of that, one of 0.5 % is a third.
    const ErrorParts large = take_apart({noisy(1.03, 0.1, 41), noisy(1.03, 0.1, 42)}, {r1, r2}, kNoisySide);
    CHECK(large.squared_bias.is_seen());
    CHECK_THAT(large.error, WithinAbs(large.variance + large.squared_bias.value, 5e-4));
    const ErrorParts none = take_apart({noisy(1.0, 0.1, 43), noisy(1.0, 0.1, 44)}, {r1, r2}, kNoisySide);
    CHECK(std::fabs(none.squared_bias.value) < 4.9 * none.squared_bias.error);
}

TEST_CASE("errors that cannot be taken apart") {
    const Picture four(4, Vec3f(1.0f));
    CHECK_THROWS_AS(take_apart({four, four}, {four, Picture(3)}, 2), Error);
    CHECK_THROWS_AS(take_apart({four, four}, {four, four}, 3), Error);
    CHECK_THROWS_AS(take_apart({four, four}, {four, four}, 0), Error);
    Picture broken = four;
    broken[2] = Vec3f(std::numeric_limits<float>::quiet_NaN());
    const ErrorParts parts = take_apart({four, broken}, {four, four}, 2);
    CHECK(parts.pixels == 3);
    CHECK(parts.invalid == 1);
    // One block gives no variance between blocks.
    CHECK_FALSE(parts.signed_bias.is_seen());
}

}  // namespace pl::test
