// Gains by hand: samples needed and their cost, the time from which a method is ahead, and the sentences about it.
#include "core/measure/gain.h"

#include <cmath>

#include "tests/support/catch.hpp"

namespace pl::test {
namespace {

/// Runs with error c / (t - setup) at `rate` samples a second, scattered by a few percent.
struct Runs {
    std::vector<RunEnd> ends;
    std::vector<Curve> curves;

    Runs(double c, double setup, double rate, int count = 10) {
        for (int i = 0; i < count; ++i) {
            const double scatter = std::exp(0.02 * (i - 0.5 * (count - 1)));
            Curve curve;
            for (double t = 0.5; t < 65.0; t *= 2.0)
                if (t > setup) curve.push_back({t, c * scatter / (t - setup)});
            ends.push_back({curve.back().error, rate * (curve.back().cost - setup), curve.back().cost});
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
    CHECK(is_decided(gain.net));
    CHECK(*gain.ahead_from_seconds == 0.5);
    CHECK_THAT(headline(gain, "default"),
               contains("needs 6.0x fewer samples than default, each costs 2.0x more: 3.0x faster to the same error "
                        "(95 %: 2.8 to 3.2), ahead from 0.5 s on"));
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

TEST_CASE("equal methods are undecided, few runs have no interval, no error no ratio") {
    const Gain equal = gain_of(Runs(2.0, 0.0, 50.0), Runs(2.01, 0.0, 50.0));
    CHECK_FALSE(is_decided(equal.net));
    CHECK_THAT(headline(equal, "default"), contains("so undecided"));
    CHECK_THAT(headline(gain_of(Runs(2.0, 0.0, 50.0, 3), Runs(1.0, 0.0, 50.0, 3)), "default"),
               contains("only 3 runs: no interval"));
    Runs below(2.0, 0.0, 50.0);
    below.ends.front().error = -1e-9;
    CHECK_THAT(headline(gain_of(Runs(2.0, 0.0, 50.0), below), "default"), contains("cannot be compared"));
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

}  // namespace pl::test
