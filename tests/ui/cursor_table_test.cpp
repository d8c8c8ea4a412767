// What runs come to at equal cost and at equal error, in hand-computed numbers, and the sentence above the plot.
#include <string>

#include "tests/support/catch.hpp"
#include "tests/ui/hand_made_runs.h"
#include "ui/accuracy/accuracy_model.h"

using namespace pl;
using namespace pl::test;

namespace {

using Kind = Cursor::Kind;

std::shared_ptr<const LiveRunSet> set_of(Runs runs) {
    auto set = std::make_shared<LiveRunSet>();
    set->runs = std::move(runs);
    return set;
}

}  // namespace

TEST_CASE("Cursors: at equal time errors are those of the curves, ratios are against default") {
    // At 3.2 s default has 32 samples and 1/32 error, reinforcement 16 and 1/64.
    const std::vector<CursorRow> rows = cursor_rows(two_runs(), kThisPicture, {}, {Kind::EqualCost, 3.2});
    REQUIRE(rows.size() == 2);
    CHECK_THAT(*rows[0].error, WithinRel(1.0 / 32.0, 1e-9));
    CHECK_THAT(*rows[0].other_cost, WithinRel(32.0, 1e-9));
    CHECK(rows[0].is_base);
    CHECK_FALSE(rows[0].ratio.has_value());
    CHECK_THAT(*rows[1].error, WithinRel(1.0 / 64.0, 1e-9));
    CHECK_THAT(*rows[1].other_cost, WithinRel(16.0, 1e-9));
    CHECK_THAT(*rows[1].ratio, WithinRel(2.0, 1e-9));
}

TEST_CASE("Cursors: at equal error it is told who was there when") {
    // 1/48 lies between points: 4.8 s for default, 12 samples and 2.4 s for reinforcement.
    const std::vector<CursorRow> rows = cursor_rows(two_runs(), kThisPicture, {}, {Kind::EqualError, 1.0 / 48.0});
    REQUIRE(rows.size() == 2);
    CHECK_THAT(*rows[0].cost, WithinRel(4.8, 1e-9));
    CHECK_THAT(*rows[0].other_cost, WithinRel(48.0, 1e-9));
    CHECK_THAT(*rows[1].cost, WithinRel(2.4, 1e-9));
    CHECK_THAT(*rows[1].other_cost, WithinRel(12.0, 1e-9));
    CHECK_THAT(*rows[1].ratio, WithinRel(2.0, 1e-9));
}

TEST_CASE("Cursors: over samples the table says seconds") {
    const CurveKind kind{ErrorMetric::RelMse, CostAxis::Samples};
    const std::vector<CursorRow> rows = cursor_rows(two_runs(), kThisPicture, kind, {Kind::EqualCost, 64.0});
    CHECK_THAT(*rows[1].other_cost, WithinRel(12.8, 1e-9));
    CHECK_THAT(*rows[1].ratio, WithinRel(4.0, 1e-9));
}

TEST_CASE("Cursors: what was not reached stays empty, and says how long it took") {
    const Runs runs = two_runs();
    // 1/200 is reached by reinforcement alone; default was measured until 12.8 s.
    const std::vector<CursorRow> at_error = cursor_rows(runs, kThisPicture, {}, {Kind::EqualError, 1.0 / 200.0});
    CHECK_FALSE(at_error[0].cost.has_value());
    CHECK_THAT(at_error[0].measured_until, WithinRel(12.8, 1e-9));
    CHECK(at_error[1].cost.has_value());
    CHECK_FALSE(at_error[1].ratio.has_value());  // not "infinitely faster"
    const std::vector<CursorRow> early = cursor_rows(runs, kThisPicture, {}, {Kind::EqualCost, 0.15});
    CHECK(early[0].error.has_value());
    CHECK_FALSE(early[1].error.has_value());
    CHECK_THAT(early[1].measured_from, WithinRel(0.2, 1e-9));
    const std::vector<CursorRow> late = cursor_rows(runs, kThisPicture, {}, {Kind::EqualCost, 20.0});
    CHECK_FALSE(late[0].error.has_value());
    CHECK(late[1].error.has_value());
}

TEST_CASE("Cursors: runs of other pictures and empty runs have no row") {
    Runs runs = two_runs();
    runs.push_back(make_run({.number = 3, .picture = 8}));
    auto empty = std::make_shared<LiveRun>();
    empty->label.picture = kThisPicture;
    runs.push_back(empty);
    CHECK(cursor_rows(runs, kThisPicture, {}, {Kind::EqualCost, 1.0}).size() == 2);
    CHECK(cursor_rows(runs, kThisPicture, {}, {}).empty());
    CHECK(cursor_rows({}, kThisPicture, {}, {Kind::EqualCost, 1.0}).empty());
}

TEST_CASE("Cursors: the picture is the one nearest in time, or the first below the error, of those kept") {
    auto run = make_run({});  // points at 0.1, 0.2, 0.4, ... s
    CHECK(point_at(*run, {}, {Kind::EqualCost, 0.45}) == 2u);
    CHECK_FALSE(point_at(*run, {}, {Kind::EqualCost, 0.05}).has_value());
    CHECK(point_at(*run, {}, {Kind::EqualError, 0.26}) == 2u);
    CHECK_FALSE(point_at(*run, {}, {Kind::EqualError, 1e-4}).has_value());
    CHECK(point_at(*run, {}, {}) == run->points.size() - 1);
    run->points[2].picture.reset();
    CHECK(point_at(*run, {}, {Kind::EqualCost, 0.45}) == 3u);
    CHECK(point_at(*run, {}, {Kind::EqualCost, 0.25}) == 1u);
    CHECK(point_at(*run, {}, {Kind::EqualCost, 1e6}) == run->points.size() - 1);
    CHECK(point_at(*run, {}, {Kind::EqualError, 0.26}) == 3u);  // never one of more error
    // An error that rose again above the cursor was not reached for good.
    run->points[4].metrics->relmse = 0.5;
    CHECK(point_at(*run, {}, {Kind::EqualError, 0.26}) == 5u);
}

TEST_CASE("Headline: factors and their product, with one run each") {
    const std::vector<Headline> lines = make_headlines(two_runs(), kThisPicture);
    REQUIRE(lines.size() == 1);
    CHECK(lines[0].run == 2);
    CHECK_THAT(lines[0].text, contains("Reinforcement CPU needs 4.0x fewer samples than Default CPU, each costs 2.0x "
                                       "more: 2.0x faster to the same error (one run each: no interval)"));
}

TEST_CASE("Headline: runs of several seeds give an interval") {
    Runs runs;
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const double luck = 1.0 + 0.02 * static_cast<double>(seed);
        const auto base = make_run({.number = 2 * seed, .error_of_sample = luck});
        const auto learned = make_run({.number = 2 * seed + 1,
                                       .method = MethodId::Reinforcement,
                                       .seconds_per_sample = 0.2,
                                       .error_of_sample = 0.25 / luck});
        base->label.seed = seed;
        learned->label.seed = seed;
        runs.push_back(base);
        runs.push_back(learned);
        const std::vector<Headline> lines = make_headlines(runs, kThisPicture);
        REQUIRE(lines.size() == 1);
        INFO(lines[0].text);
        CHECK_THAT(lines[0].text, contains(seed == 1  ? std::string("one run each: no interval")
                                           : seed < 5 ? "(only " + std::to_string(seed) + " runs: no interval)"
                                                      : std::string("(95 %: ")));
        CHECK((lines[0].text.find("seed") == std::string::npos));
    }
    // One that has just begun does not shorten the others; a second one of the same seed takes the place of the first.
    const std::string before = make_headlines(runs, kThisPicture)[0].text;
    const auto begun = make_run({.number = 20, .method = MethodId::Reinforcement, .last_sample = 4});
    begun->label.seed = 6;
    runs.push_back(begun);
    CHECK(make_headlines(runs, kThisPicture)[0].text == before);
    // What was set otherwise is no repetition.
    const auto other = make_run({.number = 21, .method = MethodId::Reinforcement});
    other->label.details = "400 volumes";
    runs.push_back(other);
    CHECK_THAT(make_headlines(runs, kThisPicture)[0].text, contains("(one run"));
}

TEST_CASE("Headline: as plain when learning loses, and without a reference") {
    const auto losing = make_run({.number = 2,
                                  .method = MethodId::Precomputed,
                                  .setup_seconds = 20.0,
                                  .seconds_per_sample = 0.4,
                                  .error_of_sample = 0.5,
                                  .with_reference = false});
    const std::vector<Headline> lines = make_headlines(Runs{make_run({}), losing}, kThisPicture);
    CHECK_THAT(lines[0].text, contains("slower to the same error"));
    CHECK_THAT(lines[0].text, contains("own noise: there is no reference"));
}

TEST_CASE("Headline: says what to do while there is nothing to compare") {
    CHECK_THAT(make_headlines({}, kThisPicture)[0].text, contains("2 and 3"));
    CHECK_THAT(make_headlines(Runs{make_run({})}, kThisPicture)[0].text, contains("Only default"));
    const Runs alone{make_run({.method = MethodId::Reinforcement})};
    CHECK_THAT(make_headlines(alone, kThisPicture)[0].text, contains("nothing to be compared with yet"));
    // A run that has just begun is there, but does not take the place of one that was measured.
    const auto begun = std::make_shared<LiveRun>(*make_run({.number = 3, .method = MethodId::Reinforcement}));
    begun->points.clear();
    CHECK_THAT(make_headlines(Runs{make_run({}), begun}, kThisPicture)[0].text, contains("too few samples"));
    Runs runs = two_runs();
    runs.push_back(begun);
    const std::vector<Headline> lines = make_headlines(runs, kThisPicture);
    REQUIRE(lines.size() == 1);
    CHECK(lines[0].text == make_headlines(two_runs(), kThisPicture)[0].text);
    // A default run of another picture is no measure.
    const Runs other{make_run({.picture = 8}), make_run({.number = 2, .method = MethodId::Reinforcement})};
    CHECK_THAT(make_headlines(other, kThisPicture)[0].text, contains("nothing to be compared with yet"));
}

TEST_CASE("Accuracy model: shows noise until an error is measured, then the error that was asked for") {
    AccuracyModel model;
    model.update(set_of({make_run({.with_reference = false})}), kThisPicture, 0.0);
    CHECK(model.kind().metric == ErrorMetric::Noise);
    CHECK(model.wanted_metric() == ErrorMetric::RelMse);
    model.set_cursor({Kind::EqualError, 0.1});
    CHECK(model.rows().size() == 1);
    model.update(set_of(two_runs()), kThisPicture, 1e-3);
    CHECK(model.kind().metric == ErrorMetric::RelMse);
    CHECK(model.cursor().kind == Kind::None);  // it was on another number
    CHECK(model.floor() == 1e-3);
    CHECK(model.lines().size() == 2);
    model.set_metric(ErrorMetric::Smape);
    CHECK(model.floor() == 0.0);  // known as relMSE only
}

TEST_CASE("Accuracy model: before the first run there is an empty plot and a sentence") {
    AccuracyModel model;
    CHECK(model.headlines().size() == 1);
    CHECK(model.lines().empty());
    CHECK(model.rows().empty());
    model.set_cursor({Kind::EqualCost, 1.0});
    model.toggle_hidden(7);
    model.fit_view();
    CHECK(model.view().x_axis().low() > 0.0);
}

TEST_CASE("Accuracy model: cursors must be positive, and end with the axis they are on") {
    AccuracyModel model;
    model.update(set_of(two_runs()), kThisPicture, 0.0);
    for (const double nonsense : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::nan("")}) {
        model.set_cursor({Kind::EqualCost, nonsense});
        CHECK(model.cursor().kind == Kind::None);
    }
    model.set_cursor({Kind::EqualCost, 2.0});
    CHECK(model.rows().size() == 2);
    model.set_axis(CostAxis::Samples);
    CHECK(model.cursor().kind == Kind::None);
    CHECK(model.rows().empty());
}

TEST_CASE("Accuracy model: the view follows the curves until a person takes it") {
    AccuracyModel model;
    model.update(set_of({make_run({.last_sample = 8})}), kThisPicture, 0.0);
    const double before = model.view().x_axis().high();
    model.update(set_of({make_run({})}), kThisPicture, 0.0);
    CHECK(model.view().x_axis().high() > before);
    model.keep_view();
    const double kept = model.view().x_axis().high();
    model.update(set_of({make_run({.last_sample = 4096})}), kThisPicture, 0.0);
    CHECK(model.view().x_axis().high() == kept);
    model.fit_view();
    CHECK(model.view().x_axis().high() > kept);
}

TEST_CASE("Accuracy model: a day of flying around does not fill the legend") {
    Runs runs;
    for (std::uint64_t i = 1; i <= 40; ++i) runs.push_back(make_run({.number = i, .picture = 100 + i}));
    runs.push_back(make_run({.number = 41}));
    AccuracyModel model;
    model.update(set_of(runs), kThisPicture, 0.0);
    REQUIRE(model.lines().size() == AccuracyModel::kOtherLines + 1);
    CHECK(model.lines().front().run == 41 - AccuracyModel::kOtherLines);
    CHECK(model.lines().back().comparable);
}

TEST_CASE("Accuracy model: a hidden run stays hidden, another picture makes runs gray") {
    AccuracyModel model;
    model.update(set_of(two_runs()), kThisPicture, 0.0);
    model.toggle_hidden(2);
    CHECK(model.lines()[1].hidden);
    model.update(set_of(two_runs()), kThisPicture + 1, 0.0);
    CHECK(model.lines()[1].hidden);
    CHECK_FALSE(model.lines()[0].comparable);
    model.toggle_hidden(2);
    CHECK_FALSE(model.lines()[1].hidden);
}
