// The gain of a method by tiles: planted factors are found where they are, and only there.
#include "core/measure/tile_gain.h"

#include <random>

#include "tests/support/catch.hpp"

using namespace pl;

namespace {

constexpr int kWidth = 128;
constexpr int kHeight = 64;

/// A picture of mean 1 whose halves have normal noise of a standard deviation by column.
struct Noisy {
    std::vector<Vec3f> first;
    std::vector<Vec3f> second;

    template <class Deviation>
    Noisy(std::uint32_t seed, Deviation deviation) {
        std::mt19937 random(seed);
        std::normal_distribution<float> normal;
        for (int i = 0; i < kWidth * kHeight; ++i) {
            const float s = deviation(i % kWidth);
            first.push_back(Vec3f{1.0f + s * normal(random)});
            second.push_back(Vec3f{1.0f + s * normal(random)});
        }
    }
    TimedHalves in(double seconds) const { return {{first, second, 1.0, 1.0}, seconds}; }
};

}  // namespace

// 32 tiles of 256 pixels: the ratio of two variances with 256 degrees of freedom each has a standard deviation of its logarithm of 0.125,
// so that factors of 4 are found by every tile (11 standard errors), and the interval of the picture has a half width of 4.4 %.
TEST_CASE("tiles find where a method gains and where it loses") {
    const Noisy base(1, [](int) { return 0.2f; });
    const Noisy method(2, [](int x) { return x < kWidth / 2 ? 0.1f : 0.4f; });
    const TileGains gains = tile_gains(base.in(3.0), method.in(3.0), kWidth);
    REQUIRE(gains.columns == 8);
    REQUIRE(gains.rows == 4);
    REQUIRE(gains.tiles.size() == 32);
    for (std::size_t i = 0; i < gains.tiles.size(); ++i) {
        CAPTURE(i, gains.tiles[i].value);
        CHECK(verdict_of(gains.tiles[i]) == (i % 8 < 4 ? Verdict::Faster : Verdict::Slower));
    }
    CHECK_THAT(gains.picture.value, WithinRel(0.04 / (0.5 * 0.01 + 0.5 * 0.16), 0.1));
}

TEST_CASE("time counts as much as noise") {
    const Noisy base(3, [](int) { return 0.2f; });
    const Noisy method(4, [](int) { return 0.1f; });
    const Interval slow = tile_gains(base.in(1.0), method.in(8.0), kWidth).picture;
    CHECK(verdict_of(slow) == Verdict::Slower);
    CHECK_THAT(slow.value, WithinRel(0.5, 0.1));
    const Interval fast = tile_gains(base.in(2.0), method.in(1.0), kWidth).picture;
    CHECK_THAT(fast.value, WithinRel(8.0, 0.1));
}

// 200 pictures of equal methods, seeds 100 to 499: a 95 % interval misses 1 in 10 of them on average; more than 24, or fewer than 1, has
// a probability below 1e-4 by the binomial distribution. An interval too narrow by a factor of 2 would miss in 65 of them.
TEST_CASE("the interval of the picture has the stated confidence") {
    int missed = 0;
    for (std::uint32_t i = 0; i < 200; ++i) {
        const Noisy base(100 + 2 * i, [](int) { return 0.2f; });
        const Noisy method(101 + 2 * i, [](int) { return 0.2f; });
        missed += tile_gains(base.in(1.0), method.in(1.0), kWidth).picture.contains(1.0) ? 0 : 1;
    }
    CHECK(missed >= 1);
    CHECK(missed <= 24);
}

TEST_CASE("a single bright pixel decides nothing") {
    const Noisy base(5, [](int) { return 0.2f; });
    Noisy method(6, [](int) { return 0.2f; });
    method.first[20 * kWidth + 20] = Vec3f{40.0f};
    const TileGains gains = tile_gains(base.in(1.0), method.in(1.0), kWidth);
    CHECK(gains.tiles[1 * 8 + 1].value < 0.5);
    CHECK(verdict_of(gains.tiles[1 * 8 + 1]) == Verdict::Undecided);
}

TEST_CASE("pixels without a value and small pictures") {
    Noisy base(7, [](int) { return 0.2f; });
    const Noisy method(8, [](int) { return 0.1f; });
    base.first[5] = Vec3f{std::numeric_limits<float>::quiet_NaN()};
    CHECK(verdict_of(tile_gains(base.in(1.0), method.in(1.0), kWidth).tiles[0]) == Verdict::Faster);
    const std::vector<Vec3f> tiny(8 * 4, Vec3f{1.0f});
    const TimedHalves flat{{tiny, tiny, 1.0, 1.0}, 1.0};
    const TileGains none = tile_gains(flat, flat, 8);
    REQUIRE(none.tiles.size() == 1);
    CHECK(mark_name(verdict_of(none.tiles[0])) == "undecided");  // no noise, no ratio
    CHECK_THROWS(tile_gains(base.in(1.0), flat, kWidth));
}

TEST_CASE("the edges of tiles leave no pixel out") {
    for (const int size : {16, 100, 127, 512})
        for (int i = 0; i < 5; ++i) CHECK(TileGains::edge(i, 5, size) < TileGains::edge(i + 1, 5, size));
    CHECK(TileGains::edge(5, 5, 127) == 127);
}
