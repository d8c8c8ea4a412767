// Gains over runs whose errors are known.
#include "tests/bench/gain_figures.h"

#include <cmath>

#include "tests/support/catch.hpp"

namespace pl::benchmarks {
namespace {

/// A run with the error `factor` / samples in all metrics, every sample taking `seconds`.
GainRun run_of(double factor, double seconds, const std::vector<std::uint32_t>& checkpoints) {
    GainRun run;
    for (const std::uint32_t samples : checkpoints) {
        Checkpoint point{.samples = samples, .seconds = seconds * samples};
        point.errors.fill(factor / samples);
        run.points.push_back(point);
    }
    return run;
}

}  // namespace

TEST_CASE("errors at a time: between checkpoints, behind the last one, and none before the first") {
    GainRun run = run_of(1.0, 1.0, {2, 8});
    run.points[1].errors.fill(2.0);  // from 0.5 at 2 s to 2 at 8 s: slope 1
    CHECK_THAT(error_at_time(run, 0, 2.0), WithinRel(0.5, 1e-12));
    CHECK_THAT(error_at_time(run, 0, 4.0), WithinRel(1.0, 1e-12));
    CHECK_THAT(error_at_time(run, 0, 16.0), WithinRel(1.0, 1e-12));
    CHECK(std::isnan(error_at_time(run, 0, 1.0)));
}

TEST_CASE("a method with a third of the error at twice the time gains 3 at equal samples and 1.5 at equal time") {
    const std::vector<GainRun> base{run_of(6.0, 0.01, {1, 64, 128}), run_of(12.0, 0.01, {1, 64, 128})};
    const std::vector<GainRun> method{run_of(2.0, 0.02, {1, 64, 128}), run_of(4.0, 0.02, {1, 64, 128})};
    const std::vector<GainFigures> figures = gain_figures(base, method, {.samples = {64, 128}, .seconds = 0.7});
    REQUIRE(figures.size() == 3);
    CHECK(figures[0].length == "0.7 s");
    CHECK(figures[2].length == "128");
    for (const GainFigures& at : figures)
        for (const Interval& factor : at.equal_time) {
            CHECK_THAT(factor.value, WithinRel(1.5, 1e-9));
            CHECK_THAT(factor.low, WithinRel(1.5, 1e-9));
        }
    CHECK(std::isnan(figures[0].equal_samples[0].value));
    CHECK_THAT(figures[2].equal_samples[0].value, WithinRel(3.0, 1e-9));
    CHECK_THAT(figures[2].slowdown.value, WithinRel(2.0, 1e-9));
    CHECK_THAT(figures[1].base_seconds.value, WithinRel(0.64, 1e-9));
}

TEST_CASE("an error below the resolution of the reference makes no gain") {
    const std::vector<GainRun> base{run_of(1.0, 1.0, {1, 2}), run_of(1.0, 1.0, {1, 2})};
    std::vector<GainRun> method = base;
    method[1].points[1].errors.fill(-0.1);
    const std::vector<GainFigures> figures = gain_figures(base, method, {.samples = {2}, .seconds = 1.0});
    CHECK(std::isnan(figures[1].equal_samples[0].value));
    CHECK(std::isnan(figures[1].equal_time[0].value));
    CHECK_THAT(figures[0].equal_time[0].value, WithinRel(1.0, 1e-12));
}

}  // namespace pl::benchmarks
