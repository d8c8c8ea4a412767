// The time that measuring the runs of a viewer may take.
#include "tests/core/measure/recording.h"
#include "tests/support/catch.hpp"

namespace pl::test {

// The rule itself is tested with made-up seconds in measure_budget_test.cpp.
TEST_CASE("the share of measuring is one of all runs together") {
    Recording never(kPlenty, 0.0);
    never.render(500);
    REQUIRE(never.count() == 1);
    CHECK(never.run(0).points.size() == 10);
    never.slot.method = MethodId::Reinforcement;
    never.render(50);
    REQUIRE(never.count() == 2);
    CHECK(never.run(1).points.size() == 10);
    CHECK_FALSE(never.run(0).in_progress);
}

namespace {

/// A clock that is read twice per measurement, which takes `cost` seconds by it.
struct MadeUpClock {
    std::shared_ptr<double> now = std::make_shared<double>(0.0);
    std::shared_ptr<double> cost = std::make_shared<double>(0.0);
    std::shared_ptr<int> readings = std::make_shared<int>(0);

    double operator()() const {
        if ((*readings)++ % 2 == 1) *now += *cost;
        return *now;
    }
};

constexpr std::size_t kInAnyCase = 10;   ///< first points of a run
constexpr double kNeverEnough = 1.0e12;  ///< seconds: of more than any test lasts, this is more than any share

}  // namespace

TEST_CASE("the first points of a run come whatever they cost, and charge no budget") {
    const MadeUpClock clock;
    *clock.cost = kNeverEnough;
    Recording recording(kPlenty, LiveRuns::kShare, MethodId::Default, clock);
    recording.render(200);
    CHECK(recording.run(0).points.size() == kInAnyCase);  // another one would take as long
    CHECK(recording.runs.current()->measure_seconds == kInAnyCase * kNeverEnough);
}

TEST_CASE("later points come as long as they are free, and end with the first one that uses up the budget") {
    const MadeUpClock clock;
    Recording recording(kPlenty, LiveRuns::kShare, MethodId::Default, clock);
    recording.record(kInAnyCase + 2);
    CHECK(recording.runs.current()->measure_seconds == 0.0);
    *clock.cost = kNeverEnough;
    recording.record(1);
    *clock.cost = 0.0;
    recording.render(200);
    CHECK(recording.run(0).points.size() == kInAnyCase + 3);
    CHECK(recording.runs.current()->measure_seconds == kNeverEnough);
}

TEST_CASE("measuring after the first points keeps within its share of the charged time") {
    const MadeUpClock clock;
    Recording recording(kPlenty, LiveRuns::kShare, MethodId::Default, clock);
    recording.record(kInAnyCase);
    // Each takes as much as the budget holds then: by the spacing of the points alone, the third one would exceed it.
    double spent = 0.0;
    double last = 0.0;
    for (int points = 0; points < 6;) {
        recording.session.advance(recording.slot);
        const double charged = charged_seconds(recording.session.clocks(recording.slot));
        *clock.cost = 0.5 * LiveRuns::kShare * charged;
        const std::size_t before = recording.points_in_progress();
        recording.runs.observe(recording.session, recording.slot);
        if (recording.points_in_progress() == before) continue;
        CHECK(spent + last <= LiveRuns::kShare * charged);
        last = *clock.cost;
        spent += last;
        ++points;
        CHECK(recording.runs.current()->measure_seconds == Approx(spent));
    }
}

}  // namespace pl::test
