// The rows of the table above the plot: which runs there are, their gains and intervals, and what they say without one.
#include "ui/plot/run_table.h"

#include <cmath>
#include <string>

#include "tests/support/catch.hpp"
#include "tests/ui/hand_made_runs.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

namespace {

std::shared_ptr<LiveRun> learned_run(std::uint64_t number, std::uint64_t seed = 1) {
    const auto run = make_run(
        {.number = number, .method = MethodId::Reinforcement, .seconds_per_sample = 0.2, .error_of_sample = 0.25});
    run->label.seed = seed;
    return run;
}

void set_block_errors(LiveRun& run, double relative) {
    for (LivePoint& point : run.points) point.relmse_off = relative * point.metrics->relmse;
}

/// The row of the only run that is compared.
RunRow compared_row(const RunTable& table) {
    std::vector<RunRow> rows = table.rows;
    std::erase_if(rows, [](const RunRow& row) { return row.missing == MissingGain::IsBase; });
    REQUIRE(rows.size() == 1);
    return rows[0];
}

}  // namespace

TEST_CASE("Run table: a row for each run with samples, cost and factor") {
    const RunTable table = make_run_table(two_runs(), kThisPicture);
    REQUIRE(table.rows.size() == 2);
    CHECK(table.note.empty());
    CHECK(table.older.empty());
    const RunRow& base = table.rows[0];
    CHECK(base.run == 1);
    CHECK(base.samples == 128.0);
    CHECK_THAT(base.seconds_per_sample, WithinRel(0.1, 1e-9));
    CHECK(gain_text(base) == "baseline");
    CHECK(interval_text(base).empty());
    const RunRow& learned = table.rows[1];
    CHECK(learned.run == 2);
    CHECK_THAT(learned.seconds_per_sample, WithinRel(0.2, 1e-9));
    CHECK(gain_text(learned) == "2x, no interval");
    CHECK_THAT(learned.remark,
               contains("Reinforcement CPU needs 4.0x fewer samples than Default CPU, each costs 2.0x "
                        "more: 2.0x faster to the same error (one run each: no interval)"));
}

TEST_CASE("Run table: single runs have the interval of their blocks, and the remark says so") {
    const auto base = make_run({});
    const auto learned = learned_run(2);
    set_block_errors(*base, 0.03);
    set_block_errors(*learned, 0.04);
    RunRow row = compared_row(make_run_table(Runs{base, learned}, kThisPicture));
    REQUIRE(row.gain);
    CHECK(row.gain->source == IntervalSource::Blocks);
    // Both logarithms have independent errors: 1.96 times the root of 0.03^2 + 0.04^2.
    CHECK_THAT(row.gain->net.low, WithinRel(2.0 * std::exp(-1.95996 * 0.05), 1e-9));
    CHECK_THAT(row.gain->net.high, WithinRel(2.0 * std::exp(1.95996 * 0.05), 1e-9));
    CHECK(gain_text(row) == "2x");
    CHECK(interval_text(row) == "1.8-2.2");
    CHECK_THAT(row.remark, contains("other seeds differ by more"));
    set_block_errors(*learned, 0.5);
    row = compared_row(make_run_table(Runs{base, learned}, kThisPicture));
    CHECK(gain_text(row) == "undecided");
    const auto equal = make_run({.number = 2, .method = MethodId::Reinforcement});
    set_block_errors(*base, 0.01);
    set_block_errors(*equal, 0.01);
    CHECK(gain_text(compared_row(make_run_table(Runs{base, equal}, kThisPicture))) == "no difference");
}

TEST_CASE("Run table: runs of several seeds share a row, and from five on they give the interval") {
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
        const RunTable table = make_run_table(runs, kThisPicture);
        CHECK(table.older.size() == 2 * (seed - 1));
        const RunRow row = compared_row(table);
        INFO(row.remark);
        CHECK(row.seeds == seed);
        CHECK((row.gain->source == IntervalSource::Seeds) == (seed == 5));
        CHECK_THAT(row.remark, contains(seed == 1  ? std::string("one run each: no interval")
                                        : seed < 5 ? "(only " + std::to_string(seed) + " runs: no interval)"
                                                   : std::string("(95 %: ")));
        CHECK((row.remark.find("seed") == std::string::npos));
    }
    // A run that has just begun does not shorten the others.
    const std::string before = compared_row(make_run_table(runs, kThisPicture)).gain->sentence;
    const auto begun = make_run({.number = 20, .method = MethodId::Reinforcement, .last_sample = 4});
    begun->label.seed = 6;
    runs.push_back(begun);
    CHECK(compared_row(make_run_table(runs, kThisPicture)).gain->sentence == before);
}

TEST_CASE("Run table: other settings are another row, a repetition replaces the older run") {
    Runs runs = two_runs();
    const auto again = learned_run(3);
    runs.push_back(again);
    RunTable table = make_run_table(runs, kThisPicture);
    CHECK(table.rows.size() == 2);
    CHECK(table.rows[1].run == 3);
    CHECK(table.older == std::vector<std::uint64_t>{2});
    for (const int change : {0, 1, 2, 3}) {
        const auto other = learned_run(10 + static_cast<std::uint64_t>(change));
        if (change == 0) other->label.details = "400 volumes";
        if (change == 1) other->label.next_event = true;
        if (change == 2) other->label.warm = true;
        if (change == 3) other->label.backend = "cuda";
        runs.push_back(other);
    }
    table = make_run_table(runs, kThisPicture);
    CHECK(table.rows.size() == 6);
    runs.push_back(learned_run(20));
    runs.back() = [&] {
        const auto other = learned_run(20);
        other->label.details = "two bounces";
        return other;
    }();
    table = make_run_table(runs, kThisPicture);
    CHECK(table.rows.size() == RunTable::kMostRows);
    CHECK(table.rows.front().run == 3);  // the baseline was used least recently
    CHECK(table.rows.front().gain);      // and is still what the others are compared with
    // A run that has just begun replaces none that was measured.
    const auto begun = std::make_shared<LiveRun>(*learned_run(30));
    begun->points.clear();
    Runs with_begun = two_runs();
    with_begun.push_back(begun);
    CHECK(make_run_table(with_begun, kThisPicture).rows[1].run == 2);
    // Nor does one that was ended after a few samples: nothing can be told of it.
    with_begun.back() = make_run({.number = 30, .method = MethodId::Reinforcement, .last_sample = 4});
    const RunTable kept = make_run_table(with_begun, kThisPicture);
    CHECK(kept.rows[1].run == 2);
    CHECK(kept.rows[1].gain);
}

TEST_CASE("Run table: one sentence on two methods in turns, by the number of the table") {
    Runs runs = two_runs();
    const std::array halves{runs[1]->label, runs[0]->label};
    RunTable table = make_run_table(runs, kThisPicture);
    // Without an interval nothing is claimed.
    CHECK(turns_headline(table, halves).text == "Both halves get the same time. Has the left one less noise?");
    CHECK(turns_headline(table, halves).detail == "");
    CHECK(turns_headline(table, halves, 1).text == "The right half catches up, until both have had the same time.");
    RunRow& row = table.rows[1];
    const auto say = [&](double low, double value, double high) {
        row.gain->net = {value, low, high};
        row.gain->source = IntervalSource::Blocks;
        return turns_headline(table, halves).text;
    };
    CHECK(say(4.9, 5.2, 5.5) ==
          "Same time, and the left half is 5.2 times ahead: its paths have learned where the light comes from.");
    CHECK(turns_headline(table, halves).detail ==
          "Measured: for the same noise the right half would need 5.2 times as long (4.9 to 5.5).");
    CHECK(learning_row(table, false) == &row);
    CHECK(learning_row(table, true) == nullptr);
    CHECK(say(0.45, 0.5, 0.55) == "Same time, and the left half is 2 times behind: learning does not pay here.");
    CHECK_THAT(say(0.8, 1.0, 1.3), contains("no difference in noise"));
    say(4.9, 5.2, 5.5);
    CHECK_THAT(turns_headline(table, {halves[1], halves[0]}).text, contains("the right half is 5.2 times ahead"));
    std::array with_light_samples = halves;
    for (RunLabel& half : with_light_samples) half.next_event = true;
    CHECK_THAT(turns_headline(table, with_light_samples).text, contains("Has the left one less noise?"));
}

TEST_CASE(
    "Run table: in turns of one method with two fields the second is the baseline of the table and the sentence") {
    Runs runs = two_runs();
    const auto tree = learned_run(3);
    tree->label.details = "SD-tree";
    for (LivePoint& point : tree->points) point.metrics->relmse *= 2.0;
    const auto learned = std::make_shared<LiveRun>(*runs[1]);
    for (LiveRun* const run : {tree.get(), learned.get()}) set_block_errors(*run, 1e-3);
    runs[1] = learned;
    const std::array halves{learned->label, tree->label};
    CHECK_FALSE(base_of_turns(runs, halves));  // not measured yet
    CHECK_THAT(turns_headline(make_run_table(runs, kThisPicture), halves).text,
               contains("Has the left one less noise?"));
    runs.push_back(tree);
    const RunTable table = make_run_table(runs, kThisPicture, base_of_turns(runs, halves));
    REQUIRE(table.rows.size() == 3);
    CHECK(gain_text(table.rows[2]) == "baseline");
    CHECK(gain_text(table.rows[1]) == "2x");
    CHECK(table.rows[0].gain);  // default, too, is compared with it
    CHECK(turns_headline(table, halves).text == "Same time, and the left half is 2 times ahead.");
    CHECK_THAT(turns_headline(table, {halves[1], halves[0]}).text, contains("Has the left one less noise?"));
    // The runs of all kinds of light sampling have default of their own for a baseline, in turns too.
    const std::array with_default{tree->label, runs[0]->label};
    CHECK_FALSE(base_of_turns(runs, with_default));
    std::array other_light = with_default;
    other_light[0].next_event = true;
    CHECK(base_of_turns(runs, other_light)->method == MethodId::Default);
    CHECK(base_of_turns(runs, {other_light[1], other_light[0]})->method == MethodId::Default);
}

TEST_CASE("Run table: as plain when learning loses, and without a reference") {
    const auto losing = make_run({.number = 2,
                                  .method = MethodId::Precomputed,
                                  .setup_seconds = 20.0,
                                  .seconds_per_sample = 0.4,
                                  .error_of_sample = 0.5,
                                  .with_reference = false});
    const RunRow row = compared_row(make_run_table(Runs{make_run({}), losing}, kThisPicture));
    CHECK_THAT(row.remark, contains("slower to the same error"));
    CHECK_THAT(row.remark, contains("own noise: there is no reference"));
    CHECK(row.gain->net.value < 1.0);
}

TEST_CASE("Run table: a baseline that is over before the other run had a few samples is compared all the same") {
    const auto slow = [](std::uint32_t last_sample) {
        return make_run({.number = 2,
                         .method = MethodId::Reinforcement,
                         .seconds_per_sample = 1.0,
                         .error_of_sample = 0.25,
                         .last_sample = last_sample});
    };
    const auto base = make_run({.seconds_per_sample = 0.1, .last_sample = 16});  // 1.6 s
    const RunRow row = compared_row(make_run_table(Runs{base, slow(128)}, kThisPicture));
    REQUIRE(row.gain);
    CHECK_THAT(row.gain->net.value, WithinRel(0.4, 1e-9));
    CHECK_THAT(row.remark, contains("Each at its end"));
    // It had enough by then: no word.
    const RunRow long_base = compared_row(make_run_table(Runs{make_run({}), slow(128)}, kThisPicture));
    REQUIRE(long_base.gain);
    CHECK(long_base.remark.find("Each at its end") == std::string::npos);
}

TEST_CASE("Run table: after nine samples of default a slower method is compared as soon as it has a few samples") {
    const auto base = make_run({.seconds_per_sample = 0.01, .last_sample = 8, .with_reference = false});
    for (const std::uint32_t last_sample : {4u, 8u, 128u}) {
        const auto slow = make_run({.number = 2,
                                    .method = MethodId::Reinforcement,
                                    .seconds_per_sample = 0.1,
                                    .last_sample = last_sample,
                                    .in_progress = true,
                                    .with_reference = false});
        const RunRow row = compared_row(make_run_table(Runs{base, slow}, kThisPicture));
        CAPTURE(last_sample, row.remark);
        CHECK(row.gain.has_value() == (last_sample >= 8));
        if (!row.gain) CHECK(row.remark == "Reinforcement CPU: too few samples to compare yet");
    }
}

TEST_CASE("Run table: a run that is over with too few samples says how it goes on") {
    const auto long_run = make_run({.number = 2, .method = MethodId::Reinforcement, .in_progress = true});
    const Runs short_base{make_run({.last_sample = 4}), long_run};
    const RunRow row = compared_row(make_run_table(short_base, kThisPicture));
    CHECK(gain_text(row) == "too short");
    CHECK(row.remark == "Default CPU has too few samples to compare, and has to go on: 1 renders default");
    const Runs short_run{make_run({.in_progress = true}),
                         make_run({.number = 2, .method = MethodId::Reinforcement, .last_sample = 4})};
    CHECK(compared_row(make_run_table(short_run, kThisPicture)).remark ==
          "Reinforcement CPU has too few samples to compare, and has to go on: 3 renders reinforcement");
    // Once it does go on, waiting helps.
    const Runs goes_on{make_run({.last_sample = 4, .in_progress = true}),
                       make_run({.number = 2, .method = MethodId::Reinforcement})};
    CHECK(compared_row(make_run_table(goes_on, kThisPicture)).remark ==
          "Default CPU: too few samples to compare yet");
}

TEST_CASE("Run table: a repetition that is over with too few samples keeps no other from being compared") {
    // Its samples took so long that it counts as a repetition.
    const auto broken_off = make_run({.number = 1, .seconds_per_sample = 3.0, .last_sample = 4});
    const auto base = make_run({.number = 2});
    base->label.seed = 2;
    const RunRow row = compared_row(make_run_table(Runs{broken_off, base, learned_run(3)}, kThisPicture));
    REQUIRE(row.gain);
    CHECK_THAT(row.gain->net.value, WithinRel(2.0, 1e-9));
    CHECK_THAT(row.remark, contains("one run each"));
}

TEST_CASE("Run table: errors against a reference that few samples have give way to the noise that all have") {
    const auto base = make_run({});
    // A reference that came late finds no pictures of later points.
    for (LivePoint& point : base->points)
        if (point.spp > 4) point.metrics.reset();
    const RunRow row = compared_row(make_run_table(Runs{base, learned_run(2)}, kThisPicture));
    REQUIRE(row.gain);
    CHECK_THAT(row.remark, contains("own noise: there is no reference"));
}

TEST_CASE("Run table: says what to do while there is nothing to compare") {
    CHECK_THAT(make_run_table({}, kThisPicture).note, contains("Nothing measured yet"));
    CHECK_THAT(make_run_table(Runs{make_run({})}, kThisPicture + 1).note, contains("Nothing measured yet"));
    const Runs rendering{make_run({.in_progress = true})};
    CHECK_THAT(make_run_table(rendering, kThisPicture).note, contains("Only default so far: 2, 3 render"));
    // Another method renders, though it is not measured yet: no claim that there is only default.
    CHECK(make_run_table(Runs{make_run({})}, kThisPicture).note.empty());
    // In turns the other run is on its way.
    CHECK(make_run_table(rendering, kThisPicture, {}, true).note ==
          "The other run is measured from its second pass on");
    CHECK(make_run_table(two_runs(), kThisPicture, {}, true).note.empty());
    const Runs alone{make_run({.method = MethodId::Reinforcement})};
    CHECK(gain_text(make_run_table(alone, kThisPicture).rows[0]) == "no baseline");
    CHECK_THAT(make_run_table(alone, kThisPicture).rows[0].remark, contains("nothing to be compared with yet"));
    const Runs few{make_run({}), make_run({.number = 3, .method = MethodId::Reinforcement, .last_sample = 4})};
    CHECK(gain_text(compared_row(make_run_table(few, kThisPicture))) == "too short");
    CHECK_THAT(compared_row(make_run_table(few, kThisPicture)).remark,
               contains("Reinforcement CPU has too few samples"));
    // A default run of another picture is no baseline.
    const Runs other{make_run({.picture = 8}), make_run({.number = 2, .method = MethodId::Reinforcement})};
    CHECK_THAT(make_run_table(other, kThisPicture).rows[0].remark, contains("nothing to be compared with yet"));
}
