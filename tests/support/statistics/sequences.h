// Checks of low-discrepancy sequences that differ from pixel to pixel.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "core/kernel/base/math.h"
#include "tests/support/catch.hpp"
#include "tests/support/statistics/rules.h"

namespace pl::test {

/// Whether every pass alone is uniform in [0, 1)^4 over 20 000 pixels: mean 1/2 to 4 %, variance 1/12 to 6 % (rule S1).
/// `numbers_of(pixel, pass)` gives a Vec4f.
template <class NumbersOf>
void check_passes_are_uniform(const NumbersOf& numbers_of) {
    for (const std::uint32_t pass : {0u, 1u, 2u, 127u, 1000000u, 0xfffffffeu})
        for (int i = 0; i < 4; ++i) {
            Moments mean, variance;
            for (std::uint32_t pixel = 0; pixel < 20000; ++pixel) {
                const auto u = static_cast<double>(numbers_of(pixel, pass)[i]);
                REQUIRE(u >= 0.0);
                REQUIRE(u < 1.0);
                mean.add(u);
                variance.add((u - 0.5) * (u - 0.5));
            }
            INFO("pass " << pass << ", number " << i);
            CHECK(mean_equals(mean, {0.5}, 0.04));
            CHECK(mean_equals(variance, {1.0 / 12.0}, 0.06));
        }
}

/// Whether two deviations of 20 000 pixels are independent; a correlation of 0.06 would be missed once in a thousand times.
/// `deviations_of(pixel)` gives the pair.
template <class DeviationsOf>
void check_independent(const DeviationsOf& deviations_of) {
    Moments product, square;
    for (std::uint32_t pixel = 0; pixel < 20000; ++pixel) {
        const std::array<double, 2> off = deviations_of(pixel);
        product.add(off[0] * off[1]);
        square.add(off[0] * off[0]);
    }
    CHECK(std::fabs(product.mean()) < kZAlpha * product.standard_error());
    CHECK(product.standard_error() < resolving_error(0.06 * square.mean()));
}

}  // namespace pl::test
