// Recorded runs of furnaces, whose picture is known exactly: convergence, the share of bias, limits, and clocks.
#include "core/measure/run_recorder.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "core/base/timer.h"
#include "tests/support/catch.hpp"
#include "tests/support/scenes/closed_scenes.h"
#include "tests/support/session/sessions.h"

namespace pl::test {
namespace {

using Picture = std::vector<Vec3f>;

constexpr float kEmission = 0.5f;

struct FurnaceRun {
    SceneDescription scene;
    RenderSettings settings;
    Picture truth;

    FurnaceRun(float albedo, MethodId method, int side, std::uint64_t seed)
        : scene(furnace_scene(kEmission, albedo)), settings(quick_learner(scene, {method, false}, side, seed)),
          truth(static_cast<std::size_t>(side * side), Vec3f(kEmission / (1.0f - albedo))) {}

    /// Measured at every step: pictures this small cost less to render than to measure.
    std::optional<RunSeries> record(RunLimits limits, const RunObserver& observer = {},
                                    const StopFlag* stop = nullptr) const {
        limits.measure_share = std::numeric_limits<double>::infinity();
        return record_within(limits, observer, stop);
    }

    std::optional<RunSeries> record_within(const RunLimits& limits, const RunObserver& observer = {},
                                           const StopFlag* stop = nullptr) const {
        Session session = make_session(scene, settings);
        return record_run(session, slot_of(settings), limits, {truth, truth}, stop, observer);
    }
};

}  // namespace

TEST_CASE("the ladder has even steps, about seven in a decade") {
    std::vector<std::uint32_t> steps;
    for (std::uint32_t spp = 0; spp < 100;) steps.push_back(spp = next_ladder_step(spp));
    CHECK((steps == std::vector<std::uint32_t>{2, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128}));
    CHECK(next_ladder_step(1) == 2);
    CHECK(next_ladder_step(5) == 6);
}

namespace {

/// 256 pixels: one run's slope over 16 to 1024 samples varies by about 0.03, the mean of 10 by 0.01.
void check_slope(float albedo, MethodId method) {
    std::vector<double> slopes;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        const auto series = FurnaceRun(albedo, method, 16, seed).record({.spp = 1024});
        slopes.push_back(log_slope(series->error_over_samples(), std::log10(1024.0 / 16.0)));
    }
    const Interval slope = mean_interval(slopes);
    CAPTURE(albedo, info_of(method).name, slope.low, slope.high);
    CHECK_THAT(slope.value, WithinAbs(-1.0, 0.05));
    CHECK(slope.high - slope.low < 0.1);  // else the test above could not fail
}

}  // namespace

TEST_CASE("the error of the furnace falls as one over the samples") { check_slope(0.5f, MethodId::Default); }
TEST_CASE("the error of the furnace family falls as one over the samples", "[merge]") {
    for (const float albedo : {0.2f, 0.8f}) check_slope(albedo, MethodId::Default);
    check_slope(0.8f, MethodId::Precomputed);
}

TEST_CASE("the noise estimated from a run's halves is its error where nothing is biased") {
    const auto series = FurnaceRun(0.8f, MethodId::Default, 64, 3).record({.spp = 48});
    const RunPoint& last = series->points.back();
    REQUIRE(last.noise);
    // 4096 pixels in three equal channels: both vary by sqrt(2/4096) = 2.2 % and are correlated; 15 % is plenty.
    CHECK_THAT(*last.noise, WithinRel(last.metrics.relmse, 0.15));
    CHECK(std::fabs(last.squared_bias->value) < 4.9 * last.squared_bias->error);
    CHECK(std::fabs(last.signed_bias->value) < 4.9 * last.signed_bias->error);
}

TEST_CASE("a planted bias of half a percent is shown as bias, not as noise") {
    // The truth is planted half a percent too high, so every picture is that much too dark.
    FurnaceRun run(0.5f, MethodId::Default, 64, 5);
    const auto honest = run.record({.spp = 256});
    for (Vec3f& pixel : run.truth) pixel *= 1.005f;
    const auto biased = run.record({.spp = 256});
    const RunPoint& a = honest->points.back();
    const RunPoint& b = biased->points.back();
    CAPTURE(b.signed_bias->value, b.signed_bias->error, a.signed_bias->value);
    CHECK_FALSE(std::fabs(a.signed_bias->value) > 4.9 * a.signed_bias->error);
    CHECK(std::fabs(b.signed_bias->value) > 4.9 * b.signed_bias->error);
    CHECK_THAT(b.signed_bias->value, WithinAbs(-0.005, 4.9 * b.signed_bias->error));
    // The estimate of noise does not see it.
    CHECK_THAT(*b.noise, WithinRel(*a.noise, 0.02));
}

TEST_CASE("a run ends at the limit that is met first, and measures its last sample") {
    const FurnaceRun run(0.5f, MethodId::Default, 8, 1);
    CHECK(run.record({.spp = 1})->points.size() == 1);
    CHECK_FALSE(run.record({.spp = 1})->points.back().noise);
    const auto spp = run.record({.spp = 7});
    CHECK(spp->points.size() == 4);
    CHECK(spp->points.back().spp == 7);
    CHECK(spp->points.back().noise);
    CHECK(run.record({.spp = 1000000, .seconds = 1e-9, .target_error = {}})->points.back().spp == 1);
    const auto target = run.record({.spp = 1000000, .seconds = {}, .target_error = 1e-2});
    CHECK(target->points.back().metrics.relmse <= 1e-2);
    CHECK(target->points[target->points.size() - 2].metrics.relmse > 1e-2);
}

// How many points a share between none and all leaves is decided by clocks: measure_budget_test.cpp tests that rule with
// made-up seconds.
TEST_CASE("points are left out that measuring has no time for, but for the first and the last one") {
    const FurnaceRun run(0.5f, MethodId::Default, 16, 1);
    const auto none = run.record_within({.spp = 200, .measure_share = 0.0});
    REQUIRE(none->points.size() == 2);
    CHECK(none->points.front().spp == 2);
    CHECK(none->points.back().spp == 200);
    const auto some = run.record_within({.spp = 200, .measure_share = 0.5});
    const auto all = run.record({.spp = 200});
    CHECK(some->points.size() >= 2);
    CHECK(some->points.size() <= all->points.size());
    std::vector<std::uint32_t> ladder{2};
    while (ladder.back() < 200) ladder.push_back(std::min(200u, next_ladder_step(ladder.back())));
    CHECK(std::ranges::equal(all->points, ladder, {}, &RunPoint::spp));
}

TEST_CASE("time spent on measuring is on no clock") {
    FurnaceRun run(0.5f, MethodId::Reinforcement, 16, 1);
    int points = 0;
    const Stopwatch watch;
    const auto series = run.record({.spp = 8}, {.on_point =
                                                    [&](const RunPoint&, const Snapshot& snapshot) {
                                                        ++points;
                                                        CHECK(snapshot.pixels.size() == 256);
                                                        const Stopwatch wait;
                                                        while (wait.seconds() < 0.2) {
                                                        }
                                                    },
                                                .on_work = {}});
    const double wall = watch.seconds();
    CHECK(points == 4);
    CHECK(series->measure_seconds > 0.0);
    const Clocks& clocks = series->points.back().clocks;
    CHECK(charged_seconds(clocks) <= wall - series->measure_seconds - 4 * 0.2);
    CHECK(charged_seconds(clocks) == clocks.place + clocks.precompute + clocks.learn + clocks.render);
    CHECK(clocks.place > 0.0);
    CHECK(clocks.learn > 0.0);
}

TEST_CASE("a run that is stopped measures nothing, and one of another size is refused") {
    FurnaceRun run(0.5f, MethodId::Default, 8, 1);
    const StopFlag stop{true};
    CHECK_FALSE(run.record({.spp = 4}, {}, &stop));
    run.truth.pop_back();
    CHECK_THROWS_AS(run.record({.spp = 4}), Error);
}

}  // namespace pl::test
