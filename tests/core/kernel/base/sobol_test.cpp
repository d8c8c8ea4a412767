// Sobol's sequence: every elementary interval of a binary net holds one point, also after scrambling, and scrambling depends on
// higher bits alone.
#include "core/kernel/base/sobol.h"

#include <set>

#include "tests/support/catch.hpp"
#include "tests/support/scenes/shapes.h"

using namespace pl;
using test::Uniforms;

namespace {

struct Point {
    std::uint32_t x, y;
};

Point sobol(std::uint32_t index) { return {reversed_bits(index), reversed_bits(sobol_second_reversed(index))}; }

Point scrambled(std::uint32_t index, std::uint32_t seed_x, std::uint32_t seed_y) {
    return {reversed_bits(scramble_reversed(index, seed_x)),
            reversed_bits(scramble_reversed(sobol_second_reversed(index), seed_y))};
}

/// Whether each of the 2^m intervals of 2^-a by 2^(a-m) holds one of the points, for all a.
template <class PointOf>
bool is_net(std::uint32_t m, const PointOf& point_of) {
    for (std::uint32_t a = 0; a <= m; ++a) {
        std::set<std::uint64_t> intervals;
        for (std::uint32_t i = 0; i < (1u << m); ++i) {
            const Point p = point_of(i);
            const std::uint64_t x = std::uint64_t{p.x} >> (32 - a);
            const std::uint64_t y = std::uint64_t{p.y} >> (32 - (m - a));
            intervals.insert(x << 32 | y);
        }
        if (intervals.size() != (1u << m)) return false;
    }
    return true;
}

}  // namespace

TEST_CASE("Reversed bits are in reverse order") {
    CHECK(reversed_bits(1u) == 0x80000000u);
    CHECK(reversed_bits(0x0000ffffu) == 0xffff0000u);
    CHECK(reversed_bits(0x12345678u) == 0x1e6a2c48u);
    Uniforms random(1);
    for (int i = 0; i < 1000; ++i) {
        const std::uint32_t x = random.bits();
        REQUIRE(reversed_bits(reversed_bits(x)) == x);
    }
}

TEST_CASE("The second dimension has the direction numbers of Sobol's") {
    std::uint32_t direction = 1u << 31;
    for (int bit = 0; bit < 32; ++bit) {
        CHECK(sobol(1u << bit).y == direction);
        direction ^= direction >> 1;
    }
    CHECK(sobol(5u).y == (sobol(4u).y ^ sobol(1u).y));
}

TEST_CASE("Points form binary nets, scrambled or not") {
    for (const std::uint32_t m : {1u, 2u, 5u, 8u}) {
        CHECK(is_net(m, sobol));
        CHECK(is_net(m, [=](std::uint32_t i) { return sobol(i + (3u << m)); }));
        Uniforms random(m);
        for (int round = 0; round < 20; ++round) {
            const std::uint32_t seed_x = random.bits();
            const std::uint32_t seed_y = random.bits();
            REQUIRE(is_net(m, [=](std::uint32_t i) { return scrambled(i, seed_x, seed_y); }));
        }
        // Points of the same first coordinate twice are no net.
        CHECK_FALSE(is_net(m, [](std::uint32_t i) { return Point{sobol(i).x, sobol(i).x}; }) == (m > 1));
    }
}

TEST_CASE("A bit of a scrambled number depends on itself and lower bits alone") {
    Uniforms random(3);
    for (int i = 0; i < 10000; ++i) {
        const std::uint32_t x = random.bits();
        const std::uint32_t seed = random.bits();
        const std::uint32_t bit = 1u << random.below(32);
        const std::uint32_t change = scramble_reversed(x, seed) ^ scramble_reversed(x ^ bit, seed);
        REQUIRE((change & (bit - 1u)) == 0u);
        REQUIRE((change & bit) != 0u);
    }
}
