// Metrics against numbers worked out by hand.
#include "core/measure/metrics.h"

#include <cmath>
#include <limits>
#include <vector>

#include "core/base/error.h"
#include "tests/support/catch.hpp"

namespace pl::test {
namespace {

using Picture = std::vector<Vec3f>;

const float kNanValue = std::numeric_limits<float>::quiet_NaN();
const float kInfinity = std::numeric_limits<float>::infinity();

}  // namespace

TEST_CASE("two gray pixels by hand") {
    // Differences 0.5 and -1 from 0.5 and 2.
    const Picture reference{Vec3f(0.5f), Vec3f(2.0f)};
    const Picture picture{Vec3f(1.0f), Vec3f(1.0f)};
    const Metrics m = measure_error(picture, reference);
    CHECK(m.pixels == 2);
    CHECK(m.invalid == 0);
    CHECK_THAT(m.mse, WithinRel((0.25 + 1.0) / 2.0, 1e-12));
    CHECK_THAT(m.rmse, WithinRel(std::sqrt(0.625), 1e-12));
    CHECK_THAT(m.relmse, WithinRel((0.25 / 0.26 + 1.0 / 4.01) / 2.0, 1e-12));
    CHECK_THAT(m.mape, WithinRel((0.5 / 0.51 + 1.0 / 2.01) / 2.0, 1e-12));
    CHECK_THAT(m.smape, WithinRel((2 * 0.5 / 1.51 + 2 * 1.0 / 3.01) / 2.0, 1e-12));
    CHECK_THAT(m.bias, WithinRel(-0.25, 1e-12));
    CHECK_THAT(m.relative_bias, WithinRel(-0.5 / 2.5, 1e-12));
    CHECK_THAT(m.psnr_db, WithinRel(10.0 * std::log10(1.0 / 0.625), 1e-12));
}

TEST_CASE("each channel is compared with its own") {
    const Picture reference{Vec3f(1.0f, 2.0f, 4.0f)};
    const Picture picture{Vec3f(2.0f, 2.0f, 1.0f)};
    const Metrics m = measure_error(picture, reference);
    CHECK_THAT(m.mse, WithinRel((1.0 + 0.0 + 9.0) / 3.0, 1e-12));
    CHECK_THAT(m.relmse, WithinRel((1.0 / 1.01 + 9.0 / 16.01) / 3.0, 1e-12));
    CHECK_THAT(m.bias, WithinRel(0.2126 * 1.0 - 0.0722 * 3.0, 1e-12));
}

TEST_CASE("equal pictures have no error, black ones too") {
    for (const float value : {0.0f, 0.25f, 1e6f}) {
        const Picture picture(5, Vec3f(value));
        const Metrics m = measure_error(picture, picture);
        CHECK(m.mse == 0.0);
        CHECK(m.relmse == 0.0);
        CHECK(m.mape == 0.0);
        CHECK(m.smape == 0.0);
        CHECK(m.bias == 0.0);
        CHECK(m.relative_bias == 0.0);
        CHECK(std::isinf(m.psnr_db));
    }
}

TEST_CASE("the trimmed twins leave out one in a thousand pixels, the worst") {
    Picture reference(1000, Vec3f(1.0f));
    Picture picture(1000, Vec3f(1.1f));
    picture[137] = Vec3f(101.0f);
    const double small = static_cast<double>(1.1f) - 1.0;
    const Metrics m = measure_error(picture, reference);
    CHECK_THAT(m.mse, WithinRel((999.0 * small * small + 1e4) / 1000.0, 1e-9));
    CHECK_THAT(m.mse_trimmed, WithinRel(small * small, 1e-9));
    CHECK_THAT(m.relmse_trimmed, WithinRel(small * small / 1.01, 1e-9));
    // However bright it is, the others lose no digit to it.
    picture[137] = Vec3f(1e19f);
    CHECK_THAT(measure_error(picture, reference).mse_trimmed, WithinRel(small * small, 1e-9));
    picture[137] = Vec3f(101.0f);
    // Below a thousand pixels the last one is kept.
    picture.resize(999);
    reference.resize(999);
    const Metrics fewer = measure_error(picture, reference);
    CHECK(fewer.mse_trimmed == fewer.mse);
}

TEST_CASE("pixels that are no numbers are counted and in no mean") {
    const Picture reference{Vec3f(1.0f), Vec3f(1.0f), Vec3f(1.0f), Vec3f(kNanValue), Vec3f(1.0f)};
    const Picture picture{Vec3f(2.0f), Vec3f(1.0f, kNanValue, 1.0f), Vec3f(1.0f, 1.0f, -kInfinity), Vec3f(1.0f),
                          Vec3f(1.0f)};
    const Metrics m = measure_error(picture, reference);
    CHECK(m.pixels == 2);
    CHECK(m.invalid == 2);
    CHECK(m.invalid_reference == 1);
    CHECK_THAT(m.mse, WithinRel(0.5, 1e-12));
    CHECK(count_invalid(picture) == 2);
    CHECK(first_invalid(picture) == 1);
    CHECK(first_invalid(reference) == 3);
    const Metrics none = measure_error(Picture(3, Vec3f(kNanValue)), Picture(3, Vec3f(1.0f)));
    CHECK(none.pixels == 0);
    CHECK(none.invalid == 3);
    CHECK(none.mse == 0.0);
}

TEST_CASE("two halves of a reference: products instead of squares, of either sign") {
    const Picture first{Vec3f(1.0f), Vec3f(0.0f)};
    const Picture second{Vec3f(3.0f), Vec3f(2.0f)};
    const Picture picture{Vec3f(2.0f), Vec3f(4.0f)};
    const Metrics m = measure_error(picture, {first, second});
    CHECK_THAT(m.mse, WithinRel((1.0 * -1.0 + 4.0 * 2.0) / 2.0, 1e-12));
    CHECK_THAT(m.relmse, WithinRel((-1.0 / 4.01 + 8.0 / 1.01) / 2.0, 1e-12));
    CHECK_THAT(m.mape, WithinRel((0.0 / 2.01 + 3.0 / 1.01) / 2.0, 1e-12));
    CHECK_THAT(m.bias, WithinRel(1.5, 1e-12));
    // The mean of the halves itself comes out below zero: not clipped, but its root is 0.
    const Metrics middle = measure_error(Picture{Vec3f(2.0f), Vec3f(1.0f)}, {first, second});
    CHECK_THAT(middle.mse, WithinRel(-1.0, 1e-12));
    CHECK(middle.rmse == 0.0);
}

TEST_CASE("pictures of different sizes are refused") {
    CHECK_THROWS_AS(measure_error(Picture(3), Picture(4)), Error);
    CHECK_THROWS_AS(measure_error(Picture(3), {Picture(3), Picture(4)}), Error);
}

}  // namespace pl::test
