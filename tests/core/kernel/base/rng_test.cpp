// Random numbers: the published vectors of Philox, the unit interval, and that no two draws share a counter.
#include "core/kernel/base/rng.h"

#include <array>
#include <set>

#include "tests/support/catch.hpp"
#include "tests/support/statistics/rules.h"

using namespace pl;

namespace {

std::array<std::uint32_t, 4> block_of(Philox counter, std::uint32_t key0, std::uint32_t key1) {
    const Philox out = philox4x32(counter, key0, key1);
    return {out.v[0], out.v[1], out.v[2], out.v[3]};
}

/// Sample correlation of `first` and `second`, two streams of uniforms.
template <class First, class Second>
double correlation(std::uint32_t pairs, First&& first, Second&& second) {
    test::Moments products;
    for (std::uint32_t i = 0; i < pairs; ++i)
        products.add((static_cast<double>(first(i)) - 0.5) * (static_cast<double>(second(i)) - 0.5) * 12.0);
    return products.mean();
}

}  // namespace

TEST_CASE("Philox gives the published vectors") {
    using Block = std::array<std::uint32_t, 4>;
    constexpr std::uint32_t kOnes = 0xffffffffu;
    CHECK(block_of({{0, 0, 0, 0}}, 0, 0) == Block{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8});
    CHECK(block_of({{kOnes, kOnes, kOnes, kOnes}}, kOnes, kOnes) ==
          Block{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd});
    CHECK(block_of({{0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}}, 0xa4093822, 0x299f31d0) ==
          Block{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1});
}

// The conversion uses the top 24 bits only, so these 2^24 values are all.
TEST_CASE("Uniforms are multiples of 2^-24, from 0 to below 1") {
    bool exact = true;
    for (std::uint32_t top = 0; top < (1u << 24); ++top) {
        const float low_bits_clear = to_unit_float(top << 8);
        const float low_bits_set = to_unit_float((top << 8) | 0xffu);
        exact = exact && low_bits_clear == low_bits_set &&
                static_cast<double>(low_bits_clear) == static_cast<double>(top) * 0x1p-24;
    }
    CHECK(exact);
    CHECK(to_unit_float(0xffffffffu) < 1.0f);
    CHECK(to_unit_float(0) == 0.0f);
}

// Philox is a bijection of its counter for each key, so draws are distinct if their counters are. A counter is read
// back to its inputs by undoing the layout, for every combination of extreme values.
TEST_CASE("No two draws share a counter") {
    const std::uint32_t words[] = {0u, 1u, 2u, 0x7fffffffu, 0x80000000u, 0xffffffffu};
    const std::uint32_t vertices[] = {0u, 1u, 2u, 63u, 64u, 0x7fffffu, 0x800000u, 0xffffffu};
    std::set<std::array<float, 4>> seen;
    std::size_t draws = 0;
    for (const Stream stream : {Stream::Picture, Stream::Precompute, Stream::Placement})
        for (const std::uint32_t pixel : words)
            for (const std::uint32_t sample : words)
                for (const std::uint32_t vertex : vertices)
                    for (std::uint32_t purpose = 0; purpose <= static_cast<std::uint32_t>(Purpose::Placement);
                         ++purpose) {
                        const Vec4f u = Rng{7, stream, pixel, sample}.draw(vertex, static_cast<Purpose>(purpose));
                        seen.insert({u.x, u.y, u.z, u.w});
                        ++draws;
                    }
    // 5184 draws of 96 bits: the probability of an accidental repetition is 2e-22.
    CHECK(seen.size() == draws);
    static_assert(static_cast<std::uint32_t>(Purpose::Placement) < 256, "purposes have eight bits of the counter");
}

TEST_CASE("Both halves of the seed count") {
    const auto draw = [](std::uint64_t seed) { return Rng{seed, Stream::Picture, 3, 4}.draw(5, Purpose::Light); };
    CHECK(draw(1) != draw(2));
    CHECK(draw(1) != draw(1 + (std::uint64_t{1} << 32)));
    CHECK(draw(1) == draw(1));
}

// Under independence the mean product has standard deviation 1/sqrt(N); alpha 1e-6 for each of four (z 4.89).
// With N = 1e6 a correlation of 0.8 % is found with probability 0.999.
TEST_CASE("Neighbouring streams are uncorrelated") {
    constexpr std::uint32_t kPairs = 1000000;
    constexpr double kLimit = test::kZAlpha / 1000.0;
    const auto by_pixel = [](std::uint32_t i) { return Rng{1, Stream::Picture, i, 0}.draw(0, Purpose::Scatter).x; };
    const auto next_pixel = [&](std::uint32_t i) { return by_pixel(i + 1); };
    const auto next_sample = [](std::uint32_t i) {
        return Rng{1, Stream::Picture, i, 1}.draw(0, Purpose::Scatter).x;
    };
    const auto next_vertex = [](std::uint32_t i) {
        return Rng{1, Stream::Picture, i, 0}.draw(1, Purpose::Scatter).x;
    };
    const auto other_purpose = [](std::uint32_t i) { return Rng{1, Stream::Picture, i, 0}.draw(0, Purpose::Lobe).x; };
    CHECK(std::abs(correlation(kPairs, by_pixel, next_pixel)) < kLimit);
    CHECK(std::abs(correlation(kPairs, by_pixel, next_sample)) < kLimit);
    CHECK(std::abs(correlation(kPairs, by_pixel, next_vertex)) < kLimit);
    CHECK(std::abs(correlation(kPairs, by_pixel, other_purpose)) < kLimit);
    // The rule can fail: a stream is correlated with itself.
    CHECK(std::abs(correlation(kPairs, by_pixel, by_pixel)) > kLimit);
}
