// Gains by hand: samples needed and their cost, the time from which a method is ahead, and the sentences about it.
// The gain of a method by tiles: planted factors are found where they are, and only there.
#include "core/measure/gain.h"

#include <cmath>
#include <limits>
#include <random>

#include "tests/support/catch.hpp"

using namespace pl;

namespace pl::test {
namespace {

/// Runs with error c / (t - setup) at `rate` samples a second, each off its neighbor by `spread`.
struct Runs {
    std::vector<RunEnd> ends;
    std::vector<Curve> curves;

    Runs(double c, double setup, double rate, int count = 10, double spread = 0.02) {
        for (int i = 0; i < count; ++i) {
            const double scatter = std::exp(spread * (i - 0.5 * (count - 1)));
            Curve curve;
            for (double t = 0.5; t < 65.0; t *= 2.0)
                if (t > setup) curve.push_back({t, c * scatter / (t - setup)});
            ends.push_back({.error = curve.back().error,
                            .samples = rate * (curve.back().cost - setup),
                            .seconds = curve.back().cost});
            curves.push_back(curve);
        }
    }
};

Gain gain_of(const Runs& base, const Runs& method) {
    return gain_over(base.ends, method.ends, base.curves, method.curves);
}

}  // namespace

TEST_CASE("fewer samples, dearer samples, and their product") {
    // No set-up: error x seconds is c. A sample's error is c x rate.
    const Gain gain = gain_of(Runs(6.0, 0.0, 100.0), Runs(2.0, 0.0, 50.0));
    CHECK_THAT(gain.net.value, WithinRel(3.0, 1e-9));
    CHECK_THAT(gain.samples.value, WithinRel(6.0, 1e-9));
    CHECK_THAT(gain.cost.value, WithinRel(0.5, 1e-9));
    CHECK_THAT(gain.samples.value * gain.cost.value, WithinRel(gain.net.value, 1e-9));
    CHECK(verdict_of(gain.net) == Verdict::Faster);
    CHECK(*gain.ahead_from_seconds == 0.5);
    CHECK_THAT(headline(gain, "default"),
               contains("needs 6.0x fewer samples than default, each costs 2.0x more: 3.0x faster to the same error "
                        "(95 %: 2.8 to 3.2), ahead from 0.5 s on"));
}

TEST_CASE("the time to the same trimmed error, where it is known") {
    Runs base(6.0, 0.0, 100.0);
    Runs method(2.0, 0.0, 50.0);
    CHECK_FALSE(std::isfinite(gain_of(base, method).net_trimmed.value));
    for (Runs* runs : {&base, &method})
        for (RunEnd& end : runs->ends) end.trimmed_error = 0.5 * end.error;
    for (RunEnd& end : method.ends) end.trimmed_error *= 0.5;
    const Gain gain = gain_of(base, method);
    CHECK_THAT(gain.net_trimmed.value, WithinRel(2.0 * gain.net.value, 1e-9));
    CHECK_THAT(gain.net_trimmed.low, WithinRel(2.0 * gain.net.low, 1e-9));
}

TEST_CASE("a loss is reported like a gain") {
    const Gain gain = gain_of(Runs(2.0, 0.0, 50.0), Runs(6.0, 0.0, 100.0));
    CHECK_THAT(gain.net.value, WithinRel(1.0 / 3.0, 1e-9));
    CHECK_FALSE(gain.ahead_from_seconds);
    CHECK_THAT(headline(gain, "default"),
               contains("needs 6.0x more samples than default, each costs 2.0x less: 3.0x slower to the same error "
                        "(95 %: 2.8 to 3.2), not ahead at 64 s"));
}

TEST_CASE("a set-up pays back when the curves cross") {
    // 6 / t against 2 / (t - 4): equal at t = 6.
    const Gain gain = gain_of(Runs(6.0, 0.0, 100.0), Runs(2.0, 4.0, 100.0));
    CHECK_THAT(*gain.ahead_from_seconds, WithinAbs(8.0, 0.5));  // 8 s: the first point after the set-up
    const Gain late = gain_of(Runs(6.0, 0.0, 100.0), Runs(5.0, 4.0, 100.0));
    CHECK_THAT(*late.ahead_from_seconds, WithinRel(24.0, 0.15));  // interpolated between points at 16 and 32 s
}

TEST_CASE("equal methods do not differ, scattered ones are undecided, few runs have no interval, no error no ratio") {
    const Gain equal = gain_of(Runs(2.0, 0.0, 50.0, 10, 0.002), Runs(2.01, 0.0, 50.0, 10, 0.002));
    CHECK(verdict_of(equal.net) == Verdict::NoDifference);
    CHECK_THAT(headline(equal, "default"),
               contains("needs as many samples as default, each costs as much: no difference in the time to the same "
                        "error (95 %: 0."));
    Runs scattered(2.2, 0.0, 50.0);
    for (std::size_t i = 0; i < scattered.ends.size(); ++i) scattered.ends[i].error *= i % 2 == 0 ? 0.5 : 2.0;
    const Gain unclear = gain_of(Runs(2.0, 0.0, 50.0), scattered);
    CHECK(verdict_of(unclear.net) == Verdict::Undecided);
    CHECK_THAT(headline(unclear, "default"), contains("undecided which is faster to the same error (95 %: 0."));
    CHECK_THAT(headline(gain_of(Runs(2.0, 0.0, 50.0, 1), Runs(2.01, 0.0, 50.0, 1)), "default"),
               contains("about as fast to the same error (one run each: no interval)"));
    CHECK_THAT(headline(gain_of(Runs(2.0, 0.0, 50.0, 3), Runs(1.0, 0.0, 50.0, 3)), "default"),
               contains("only 3 runs: no interval"));
    Runs below(2.0, 0.0, 50.0);
    below.ends.front().error = -1e-9;
    CHECK_THAT(headline(gain_of(Runs(2.0, 0.0, 50.0), below), "default"), contains("cannot be compared"));
}

TEST_CASE("the verdict is what the interval supports") {
    constexpr double kNone = std::numeric_limits<double>::infinity();
    CHECK(verdict_text({1.7, 1.5, 1.9}) == "1.7x faster");
    CHECK(verdict_text({0.5, 0.4, 0.6}) == "2.0x slower");
    CHECK(verdict_text({1.02, 1.01, 1.03}) == "no difference");  // decided, and too little to name
    CHECK(verdict_text({1.02, 0.8, 1.3}) == "undecided");
    CHECK(verdict_text({3.0, 0.0, kNone}) == "undecided");
    CHECK(verdict_text({std::nan(""), 0.0, kNone}) == "not resolved");
}

TEST_CASE("the range that all runs cover") {
    const Runs a(1.0, 0.0, 1.0), b(1.0, 4.0, 1.0);
    std::vector<Curve> both = a.curves;
    both.insert(both.end(), b.curves.begin(), b.curves.end());
    CHECK(common_range(both)->first == 8.0);
    CHECK(common_range(both)->last == 64.0);
    CHECK_FALSE(common_range({}));
    both.push_back({});
    CHECK_FALSE(common_range(both));
    const std::vector<double> spaced = log_spaced(1.0, 100.0, 3);
    CHECK_THAT(spaced[1], WithinRel(10.0, 1e-12));
    CHECK(spaced[2] == 100.0);
}

TEST_CASE("Gain: ratios have two digits, large ones no exponent") {
    CHECK(ratio_text(0.531) == "0.53");
    CHECK(ratio_text(1.449) == "1.4");
    CHECK(ratio_text(99.4) == "99");
    CHECK(ratio_text(99.6) == "100");
    CHECK(ratio_text(143.2) == "143");
    CHECK(ratio_text(2e7) == "2e+07");
}

}  // namespace pl::test

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
