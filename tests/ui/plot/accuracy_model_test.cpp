#include <string>

#include "tests/support/catch.hpp"
#include "tests/ui/hand_made_runs.h"
#include "ui/plot/accuracy_model.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

namespace {

using CursorKind = Cursor::Kind;

std::shared_ptr<const LiveRunSet> set_of(Runs runs) {
    auto set = std::make_shared<LiveRunSet>();
    set->runs = std::move(runs);
    return set;
}

}  // namespace

TEST_CASE("Accuracy model: shows noise until an error is measured, then the error that was asked for") {
    AccuracyModel model;
    model.update(set_of({make_run({.with_reference = false})}), kThisPicture, 0.0);
    CHECK(model.kind().metric == ErrorMetric::Noise);
    CHECK(model.wanted_metric() == ErrorMetric::RelMse);
    model.set_cursor({CursorKind::EqualError, 0.1});
    CHECK(model.rows().size() == 1);
    model.update(set_of(two_runs()), kThisPicture, 1e-3);
    CHECK(model.kind().metric == ErrorMetric::RelMse);
    CHECK(model.cursor().kind == CursorKind::None);  // it was on another number
    CHECK(model.floor() == 1e-3);
    CHECK(model.lines().size() == 2);
    model.set_metric(ErrorMetric::Smape);
    CHECK(model.floor() == 0.0);  // known as relMSE only
}

TEST_CASE("Accuracy model: before the first run there is an empty plot and a note") {
    AccuracyModel model;
    CHECK(model.table().rows.empty());
    CHECK_FALSE(model.table().note.empty());
    CHECK(model.lines().empty());
    CHECK(model.rows().empty());
    model.set_cursor({CursorKind::EqualCost, 1.0});
    model.toggle_hidden(7);
    model.fit_view();
    CHECK(model.view().x_axis().low() > 0.0);
}

TEST_CASE("Accuracy model: cursors must be positive, and end with the axis they are on") {
    AccuracyModel model;
    model.update(set_of(two_runs()), kThisPicture, 0.0);
    for (const double nonsense : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::nan("")}) {
        model.set_cursor({CursorKind::EqualCost, nonsense});
        CHECK(model.cursor().kind == CursorKind::None);
    }
    model.set_cursor({CursorKind::EqualCost, 2.0});
    CHECK(model.rows().size() == 2);
    model.set_axis(CostAxis::Samples);
    CHECK(model.cursor().kind == CursorKind::None);
    CHECK(model.rows().empty());
}

TEST_CASE("Accuracy model: the view follows the curves until a person takes it") {
    AccuracyModel model;
    model.update(set_of({make_run({.last_sample = 8})}), kThisPicture, 0.0);
    const double before = model.view().x_axis().high();
    model.update(set_of({make_run({})}), kThisPicture, 0.0);
    CHECK(model.view().x_axis().high() > before);
    model.zoom_view(0.0f, {10.0f, 10.0f}, {0.0f, 0.0f, 100.0f, 100.0f});
    const double kept = model.view().x_axis().high();
    model.update(set_of({make_run({.last_sample = 4096})}), kThisPicture, 0.0);
    CHECK(model.view().x_axis().high() == kept);
    model.fit_view();
    CHECK(model.view().x_axis().high() > kept);
    const Rect frame{0.0f, 0.0f, 100.0f, 100.0f};
    const double fitted = model.view().x_axis().high();
    for (int i = 0; i < 40; ++i) model.zoom_view(-1.0f, {50.0f, 50.0f}, frame);
    for (int i = 0; i < 40; ++i) model.pan_view({-500.0f, 0.0f}, frame);
    CHECK_THAT(model.view().x_axis().high(), WithinRel(10.0 * fitted, 1e-9));
    // Another picture with curves elsewhere: a kept view goes to them.
    model.update(set_of({make_run({.seconds_per_sample = 1e-4, .last_sample = 8, .picture = kThisPicture + 1})}),
                 kThisPicture + 1, 0.0);
    CHECK(model.view().x_axis().high() < 1.0);
}

TEST_CASE("Accuracy model: runs of other pictures are not plotted, and come back with their picture") {
    AccuracyModel model;
    model.update(set_of(two_runs()), kThisPicture, 0.0);
    model.toggle_hidden(2);
    CHECK(model.lines()[1].hidden);
    model.update(set_of(two_runs()), kThisPicture + 1, 0.0);
    CHECK(model.lines().empty());
    model.update(set_of(two_runs()), kThisPicture, 0.0);
    REQUIRE(model.lines().size() == 2);
    CHECK_FALSE(model.lines()[0].hidden);
    CHECK(model.lines()[1].hidden);
    model.toggle_hidden(2);
    CHECK_FALSE(model.lines()[1].hidden);
}

TEST_CASE("Accuracy model: a row is old while a picture of its comparison has many samples more than were measured") {
    Runs runs = two_runs();
    AccuracyModel model;
    model.update(set_of(runs), kThisPicture, 0.0);
    const auto is_old = [&] { return model.is_old(model.table().rows.at(1)); };
    model.set_passes(129);
    CHECK_FALSE(is_old());
    model.set_passes(400);
    CHECK(is_old());
    CHECK(model.age_text(model.table().rows.at(1)) ==
          "Reinforcement CPU: measured after 128 of 400 samples per pixel.");
    CHECK_FALSE(model.is_old(model.table().rows.at(0)));  // it waits, with all that was rendered
    // The baseline rendered on without being measured before it was left.
    const auto base = std::make_shared<LiveRun>(*runs[0]);
    base->passes = 1000;
    runs[0] = base;
    model.update(set_of(runs), kThisPicture, 0.0);
    model.set_passes(129);
    CHECK(is_old());
    CHECK(model.age_text(model.table().rows.at(1)) == "Default CPU: measured after 128 of 1000 samples per pixel.");
}
