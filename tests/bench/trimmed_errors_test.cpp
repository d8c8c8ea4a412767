#include "tests/bench/trimmed_errors.h"

#include <limits>
#include <vector>

#include "tests/support/catch.hpp"

namespace pl::benchmarks {
namespace {

using Picture = std::vector<Vec3f>;

const float kNanValue = std::numeric_limits<float>::quiet_NaN();

}  // namespace

TEST_CASE("errors without a share of the pixels: those where each is largest") {
    // Squares 1, 4, 9, ... 100; the last pixel is the worst by MSE, and by relMSE the best, for its reference is bright.
    Picture reference(10, Vec3f(0.0f));
    Picture picture;
    for (int i = 1; i <= 10; ++i) picture.push_back(Vec3f(static_cast<float>(i)));
    reference[9] = Vec3f(1000.0f);
    picture[9] = Vec3f(1010.0f);
    const PictureHalves same{reference, reference};
    const TrimmedErrors whole = measure_trimmed(picture, same, 0.0);
    CHECK_THAT(whole.mse, WithinRel(385.0 / 10.0, 1e-12));
    CHECK_THAT(whole.mse, WithinRel(measure_error(picture, reference).mse, 1e-12));
    CHECK_THAT(whole.relmse, WithinRel(measure_error(picture, reference).relmse, 1e-12));
    const TrimmedErrors without_two = measure_trimmed(picture, same, 0.29);
    CHECK_THAT(without_two.mse, WithinRel((385.0 - 100.0 - 81.0) / 8.0, 1e-12));
    CHECK_THAT(without_two.relmse,
               WithinRel(((1.0 + 4.0 + 9.0 + 16.0 + 25.0 + 36.0 + 49.0) / 0.01 + 1e-4) / 8.0, 1e-9));
    CHECK(measure_trimmed(Picture(3, Vec3f(kNanValue)), {Picture(3), Picture(3)}, 0.01).mse == 0.0);
}

TEST_CASE("errors without a share of the pixels: outliers of a reference's half go, whatever their sign") {
    // A quarter of the pixels has an outlier in one half: the product is 1 * 99 or 1 * -101, the truth is 1.
    Picture first(1000, Vec3f(0.0f));
    const Picture second(1000, Vec3f(0.0f));
    const Picture picture(1000, Vec3f(1.0f));
    for (std::size_t i = 0; i < 250; ++i) first[i] = Vec3f(i % 2 == 0 ? 102.0f : -98.0f);
    CHECK_THAT(measure_trimmed(picture, {first, second}, 0.25).mse, WithinRel(1.0, 1e-12));
}

TEST_CASE("errors without one in a thousand pixels are the trimmed twins") {
    Picture reference(2000);
    Picture picture(2000);
    for (std::size_t i = 0; i < picture.size(); ++i) {
        reference[i] = Vec3f(0.01f * static_cast<float>(i % 37));
        picture[i] = Vec3f(0.02f * static_cast<float>(i % 41), 0.3f, 0.001f * static_cast<float>(i));
    }
    const Metrics metrics = measure_error(picture, reference);
    const TrimmedErrors errors = measure_trimmed(picture, {reference, reference}, kTrimmedShare);
    CHECK_THAT(errors.mse, WithinRel(metrics.mse_trimmed, 1e-9));
    CHECK_THAT(errors.relmse, WithinRel(metrics.relmse_trimmed, 1e-9));
}

}  // namespace pl::benchmarks
