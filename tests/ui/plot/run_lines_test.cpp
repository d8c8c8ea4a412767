// Runs at equal cost and at equal error, in hand-computed numbers.
#include "ui/plot/run_lines.h"

#include <string>

#include "tests/support/catch.hpp"
#include "tests/ui/hand_made_runs.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

namespace {

using CursorKind = Cursor::Kind;

}  // namespace

TEST_CASE("Cursors: at equal time errors are those of the curves, ratios are against default") {
    // At 3.2 s default has 32 samples and 1/32 error, reinforcement 16 and 1/64.
    const std::vector<CursorRow> rows = cursor_rows(two_runs(), kThisPicture, {}, {CursorKind::EqualCost, 3.2});
    REQUIRE(rows.size() == 2);
    CHECK_THAT(*rows[0].error, WithinRel(1.0 / 32.0, 1e-9));
    CHECK_THAT(*rows[0].other_cost, WithinRel(32.0, 1e-9));
    CHECK(rows[0].is_base);
    CHECK_FALSE(rows[0].ratio.has_value());
    CHECK_THAT(*rows[1].error, WithinRel(1.0 / 64.0, 1e-9));
    CHECK_THAT(*rows[1].other_cost, WithinRel(16.0, 1e-9));
    CHECK_THAT(*rows[1].ratio, WithinRel(2.0, 1e-9));
}

TEST_CASE("Cursors: ratios are against the base that is chosen") {
    const Runs runs = two_runs();
    const std::vector<CursorRow> rows =
        cursor_rows(runs, kThisPicture, {}, {CursorKind::EqualCost, 3.2}, runs[1]->label);
    REQUIRE(rows.size() == 2);
    CHECK_THAT(*rows[0].ratio, WithinRel(0.5, 1e-9));
    CHECK(rows[1].is_base);
}

TEST_CASE("Cursors: at equal error it is told who was there when") {
    // 1/48 lies between points: 4.8 s for default, 12 samples and 2.4 s for reinforcement.
    const std::vector<CursorRow> rows =
        cursor_rows(two_runs(), kThisPicture, {}, {CursorKind::EqualError, 1.0 / 48.0});
    REQUIRE(rows.size() == 2);
    CHECK_THAT(*rows[0].cost, WithinRel(4.8, 1e-9));
    CHECK_THAT(*rows[0].other_cost, WithinRel(48.0, 1e-9));
    CHECK_THAT(*rows[1].cost, WithinRel(2.4, 1e-9));
    CHECK_THAT(*rows[1].other_cost, WithinRel(12.0, 1e-9));
    CHECK_THAT(*rows[1].ratio, WithinRel(2.0, 1e-9));
}

TEST_CASE("Cursors: over samples the table says seconds") {
    const CurveKind kind{ErrorMetric::RelMse, CostAxis::Samples};
    const std::vector<CursorRow> rows = cursor_rows(two_runs(), kThisPicture, kind, {CursorKind::EqualCost, 64.0});
    CHECK_THAT(*rows[1].other_cost, WithinRel(12.8, 1e-9));
    CHECK_THAT(*rows[1].ratio, WithinRel(4.0, 1e-9));
}

TEST_CASE("Cursors: what was not reached stays empty, and says how long it took") {
    const Runs runs = two_runs();
    // 1/200 is reached by reinforcement alone; default was measured until 12.8 s.
    const std::vector<CursorRow> at_error =
        cursor_rows(runs, kThisPicture, {}, {CursorKind::EqualError, 1.0 / 200.0});
    CHECK_FALSE(at_error[0].cost.has_value());
    CHECK_THAT(at_error[0].measured_until, WithinRel(12.8, 1e-9));
    CHECK(at_error[1].cost.has_value());
    CHECK_FALSE(at_error[1].ratio.has_value());  // not "infinitely faster"
    const std::vector<CursorRow> early = cursor_rows(runs, kThisPicture, {}, {CursorKind::EqualCost, 0.15});
    CHECK(early[0].error.has_value());
    CHECK_FALSE(early[1].error.has_value());
    CHECK_THAT(early[1].measured_from, WithinRel(0.2, 1e-9));
    const std::vector<CursorRow> late = cursor_rows(runs, kThisPicture, {}, {CursorKind::EqualCost, 20.0});
    CHECK_FALSE(late[0].error.has_value());
    CHECK(late[1].error.has_value());
}

TEST_CASE("Cursors: runs of other pictures and empty runs have no row") {
    Runs runs = two_runs();
    runs.push_back(make_run({.number = 3, .picture = 8}));
    auto empty = std::make_shared<LiveRun>();
    empty->label.picture = kThisPicture;
    runs.push_back(empty);
    CHECK(cursor_rows(runs, kThisPicture, {}, {CursorKind::EqualCost, 1.0}).size() == 2);
    CHECK(cursor_rows(runs, kThisPicture, {}, {}).empty());
    CHECK(cursor_rows({}, kThisPicture, {}, {CursorKind::EqualCost, 1.0}).empty());
}

TEST_CASE("Cursors: the picture is the one nearest in time, or the first below the error, of those kept") {
    auto run = make_run({});  // points at 0.1, 0.2, 0.4, ... s
    CHECK(point_at(*run, {}, {CursorKind::EqualCost, 0.45}) == 2u);
    CHECK_FALSE(point_at(*run, {}, {CursorKind::EqualCost, 0.05}).has_value());
    CHECK(point_at(*run, {}, {CursorKind::EqualError, 0.26}) == 2u);
    CHECK_FALSE(point_at(*run, {}, {CursorKind::EqualError, 1e-4}).has_value());
    CHECK(point_at(*run, {}, {}) == run->points.size() - 1);
    run->points[2].picture.reset();
    CHECK(point_at(*run, {}, {CursorKind::EqualCost, 0.45}) == 3u);
    CHECK(point_at(*run, {}, {CursorKind::EqualCost, 0.25}) == 1u);
    CHECK(point_at(*run, {}, {CursorKind::EqualCost, 1e6}) == run->points.size() - 1);
    CHECK(point_at(*run, {}, {CursorKind::EqualError, 0.26}) == 3u);  // never one of more error
    // An error that rose again above the cursor was not reached for good.
    run->points[4].metrics->relmse = 0.5;
    CHECK(point_at(*run, {}, {CursorKind::EqualError, 0.26}) == 5u);
}

TEST_CASE("Runs: settings of their own stand first in the name, and have a color of their own") {
    Runs runs = two_runs();
    const auto tree = make_run({.number = 3, .method = MethodId::Reinforcement});
    const auto many = make_run({.number = 4, .method = MethodId::Reinforcement});
    tree->label.details = "SD-tree";
    many->label.details = "4000 volumes";
    runs.push_back(tree);
    runs.push_back(many);
    CHECK(name_of(tree->label) == "Reinforcement (SD-tree) CPU");
    CHECK(run_color(runs, runs[1]->label) == info_of(MethodId::Reinforcement).color);
    CHECK(run_color(runs, tree->label) != run_color(runs, runs[1]->label));
    CHECK(run_color(runs, tree->label) != run_color(runs, many->label));
}
