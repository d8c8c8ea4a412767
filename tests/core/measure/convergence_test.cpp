// Curves of error over time: interpolation, targets that are missed, slopes.
#include "core/measure/convergence.h"

#include <cmath>

#include "tests/support/catch.hpp"

namespace pl::test {
namespace {

/// Error c / (t - start): noise alone, after a set-up.
Curve noise_curve(double c, double start = 0.0) {
    Curve curve;
    for (double t = 1.0; t < 200.0; t *= 2.0)
        if (t > start) curve.push_back({t, c / (t - start)});
    return curve;
}

}  // namespace

TEST_CASE("between points errors lie on lines in log-log, outside they are unknown") {
    const Curve curve = noise_curve(8.0);
    CHECK_THAT(*error_at(curve, 4.0), WithinRel(2.0, 1e-12));
    CHECK_THAT(*error_at(curve, 5.0), WithinRel(8.0 / 5.0, 1e-12));
    CHECK_FALSE(error_at(curve, 0.5));
    CHECK_FALSE(error_at(curve, 129.0));
    CHECK_FALSE(error_at({}, 1.0));
    CHECK_FALSE(error_at({{1.0, -1.0}, {2.0, 1.0}}, 1.5));
}

TEST_CASE("a target is reached where the error stays below it") {
    CHECK_THAT(*cost_to_reach(noise_curve(8.0), 1.6), WithinRel(5.0, 1e-12));
    CHECK_FALSE(cost_to_reach(noise_curve(8.0), 0.01));
    // A lucky early point does not count.
    const Curve lucky{{1.0, 0.5}, {2.0, 4.0}, {4.0, 1.0}, {8.0, 0.25}};
    CHECK_THAT(*cost_to_reach(lucky, 0.5), WithinRel(std::sqrt(32.0), 1e-12));
    // Already there at the first point: no earlier time is known.
    CHECK(*cost_to_reach(lucky, 10.0) == 1.0);
    CHECK_FALSE(cost_to_reach({}, 1.0));
}

TEST_CASE("runs that miss a target are counted, not dropped") {
    const std::vector<Curve> runs{noise_curve(8.0), noise_curve(32.0), noise_curve(8.0 * 128.0 * 2.0)};
    const TimeToTarget time = time_to_target(runs, 1.0);
    CHECK(time.reached == 2);
    CHECK(time.censored == 1);
    CHECK(time.more_than == 128.0);
    CHECK_THAT(time.cost.value, WithinRel(16.0, 1e-12));
    const TimeToTarget none = time_to_target(runs, 1e-6);
    CHECK(none.reached == 0);
    CHECK(none.censored == 3);
    CHECK(std::isnan(none.cost.value));
}

TEST_CASE("slopes distinguish noise from a floor") {
    CHECK_THAT(log_slope(noise_curve(8.0)), WithinRel(-1.0, 1e-12));
    Curve biased = noise_curve(8.0);
    for (CurvePoint& point : biased) point.error += 0.5;
    CHECK(log_slope(biased) > -0.5);
    CHECK(std::isnan(log_slope({{1.0, 1.0}, {2.0, 0.5}})));
    const Interval slope = slope_interval(std::vector<Curve>{noise_curve(1.0), noise_curve(3.0)});
    CHECK_THAT(slope.value, WithinRel(-1.0, 1e-9));
}

TEST_CASE("the error at a time needs every run") {
    const std::vector<Curve> runs{noise_curve(1.0), noise_curve(4.0)};
    CHECK_THAT(error_interval_at(runs, 8.0)->value, WithinRel(0.25, 1e-12));
    CHECK_FALSE(error_interval_at(std::vector<Curve>{noise_curve(1.0), noise_curve(1.0, 10.0)}, 8.0));
    CHECK_FALSE(error_interval_at({}, 8.0));
}

}  // namespace pl::test
