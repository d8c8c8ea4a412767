// Half floats: every one there and back, and the floats between and beyond them.
#include "core/kernel/base/half.h"

#include <cmath>
#include <limits>

#include "tests/support/catch.hpp"

using namespace pl;

TEST_CASE("every half float comes back from a float") {
    int wrong = 0;
    for (std::uint32_t bits = 0; bits < 0x10000u; ++bits) {
        const auto half = static_cast<std::uint16_t>(bits);
        if ((half & 0x7fffu) >= 0x7c00u) continue;  // infinities and NaNs
        wrong += to_half(from_half(half)) == half ? 0 : 1;
    }
    CHECK(wrong == 0);
    CHECK(from_half(0x3c00u) == 1.0f);
    CHECK(from_half(0x3555u) == 1365.0f / 4096.0f);
    CHECK(from_half(0x0001u) == std::ldexp(1.0f, -24));
    CHECK(from_half(0x0400u) == std::ldexp(1.0f, -14));
    CHECK(from_half(0x7bffu) == 65504.0f);
    CHECK(std::isinf(from_half(0x7c00u)));
    CHECK(std::isnan(from_half(0x7e00u)));
}

TEST_CASE("a float between two half floats goes to the nearer one, ties to the even one") {
    int wrong = 0;
    for (std::uint32_t bits = 0; bits < 0x7bffu; ++bits) {
        const auto low = static_cast<std::uint16_t>(bits);
        const auto high = static_cast<std::uint16_t>(bits + 1);
        const float middle = 0.5f * (from_half(low) + from_half(high));  // exact
        const std::uint16_t even = (low & 1u) == 0 ? low : high;
        wrong += to_half(middle) == even ? 0 : 1;
        wrong += to_half(std::nextafter(middle, 0.0f)) == low ? 0 : 1;
        wrong += to_half(std::nextafter(middle, 1e9f)) == high ? 0 : 1;
        wrong += to_half(-middle) == (even | 0x8000u) ? 0 : 1;
    }
    CHECK(wrong == 0);
}

TEST_CASE("a float beyond the largest half float becomes that one, and NaN stays NaN") {
    for (const float large : {65504.0f, 65519.0f, 65520.0f, 1e30f, std::numeric_limits<float>::infinity()}) {
        CHECK(from_half(to_half(large)) == 65504.0f);
        CHECK(from_half(to_half(-large)) == -65504.0f);
    }
    CHECK(std::isnan(from_half(to_half(std::numeric_limits<float>::quiet_NaN()))));
    CHECK(to_half(0.0f) == 0);
    CHECK(to_half(1e-30f) == 0);
}
