// The two sides of a comparison.
#include "tests/support/catch.hpp"
#include "tests/ui/hand_made_comparison.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

TEST_CASE("Sides: automatic ones are the run in progress and default") {
    const Runs runs = two_runs();
    const CompareSides sides = resolve_sides(input_of(runs), {});
    REQUIRE((sides.a && sides.b));
    CHECK(sides.a->run == 2);
    CHECK(sides.a->is_live);
    CHECK(sides.b->run == 1);
    CHECK_FALSE(sides.b->is_live);
    CHECK(sides.a->label == "Reinforcement CPU  128 spp  25.6 s");
    CHECK(sides.fit_together());
}

TEST_CASE("Sides: with one run the reference is the other, without it there is none") {
    const Runs runs{make_run({})};
    const ReferencePicture reference = reference_of();
    CHECK(resolve_sides(input_of(runs, &reference), {}).b->is_reference);
    CHECK_FALSE(resolve_sides(input_of(runs), {}).b.has_value());
    const ReferencePicture foreign = reference_of(99);
    CHECK_FALSE(resolve_sides(input_of(runs, &foreign), {}).b.has_value());
    CHECK_FALSE(resolve_sides(input_of({}), {}).a.has_value());
}

TEST_CASE("Sides: a choice counts as long as it shows this picture") {
    Runs runs = two_runs();
    runs.push_back(make_run({.number = 3, .method = MethodId::Precomputed}));
    runs.push_back(make_run({.number = 4, .picture = 8}));
    CompareState state;
    state.a = {SideChoice::What::Run, 3};
    state.b = {SideChoice::What::Run, 2};
    CHECK(resolve_sides(input_of(runs), state).a->run == 3);
    CHECK(resolve_sides(input_of(runs), state).b->run == 2);
    state.a.run = 4;
    CHECK(resolve_sides(input_of(runs), state).a->run == 2);
    state.b = {SideChoice::What::Reference, 0};
    const ReferencePicture reference = reference_of();
    CHECK(resolve_sides(input_of(runs, &reference), state).b->is_reference);
    CHECK(resolve_sides(input_of(runs), state).b->run == 1);  // there is no reference: automatic
}

TEST_CASE("Sides: the picture of a file is either side, and the other one is a run") {
    const Runs runs = two_runs();
    const OpenedPicture opened{.pixels = plain_picture(0x3800), .name = "other.exr"};
    CompareState state;
    state.b = {SideChoice::What::File, 0};
    CompareInput input = input_of(runs);
    CHECK(resolve_sides(input, state).b->run == 1);  // nothing is opened: automatic
    input.file = &opened;
    CHECK(resolve_sides(input, state).a->run == 2);
    CHECK(resolve_sides(input, state).b->picture == opened.pixels);
    CHECK(resolve_sides(input, state).b->label == "other.exr");
    CHECK(resolve_sides(input, state).fit_together());
    const OpenedPicture clipped{.pixels = opened.pixels, .name = "other.png", .is_display = true};
    input.file = &clipped;
    CHECK(resolve_sides(input, state).b->label == "other.png  display values");
    CHECK_FALSE(resolve_sides(input, state).fit_together());
    input.file = &opened;
    std::swap(state.a, state.b);
    CHECK(resolve_sides(input, state).a->label == "other.exr");
    CHECK(resolve_sides(input, state).b->run == 2);
}

TEST_CASE("Sides: cursors choose the pictures, and what is missing is said") {
    const Runs runs = two_runs();
    const Cursor time{Cursor::Kind::EqualCost, 3.3};
    const CompareSides equal_time = resolve_sides(input_of(runs, nullptr, time), {});
    CHECK(equal_time.a->label == "Reinforcement CPU  16 spp  3.2 s");
    CHECK(equal_time.b->label == "Default CPU  32 spp  3.2 s");
    CHECK_FALSE(equal_time.a->is_live);
    const Cursor between{Cursor::Kind::EqualCost, 4.0};
    CHECK_THAT(resolve_sides(input_of(runs, nullptr, between), {}).b->label,
               contains("32 spp  3.2 s  (nearest kept)"));
    const Cursor error{Cursor::Kind::EqualError, 1.0 / 200.0};
    const CompareSides equal_error = resolve_sides(input_of(runs, nullptr, error), {});
    CHECK(equal_error.a->label == "Reinforcement CPU  64 spp  12.8 s");
    CHECK(equal_error.b->picture == nullptr);
    CHECK_THAT(equal_error.b->label, contains("Default CPU: no picture at relMSE 0.005"));
    const ComparePlan plan = plan_comparison(equal_error, state_of(CompareMode::Split), nullptr, kView);
    CHECK(plan.tiles.size() == 1);
    CHECK_THAT(plan.hint, contains("no picture at relMSE"));
}

TEST_CASE("Sides: a newer frame of the run in progress is shown, with the seconds that the run is charged") {
    const Runs runs = two_runs();
    CompareSide side = *resolve_sides(input_of(runs), {}).a;
    auto frame = std::make_shared<PublishedFrame>();
    frame->backend.name = "cpu";
    frame->snapshot.slot.method = MethodId::Reinforcement;
    frame->snapshot.width = 4;
    frame->snapshot.height = 2;
    frame->snapshot.passes = 130;
    frame->snapshot.clocks.place = 100.0;  // spent before a warm run began
    frame->snapshot.clocks.render = 26.0;
    show_newer(side, frame);
    CHECK(side.frame == frame);
    CHECK(side.label == "Reinforcement CPU  130 spp  26 s");
    // Coarse sides, and sides of other pictures, are not.
    const auto refused = [&](auto change) {
        CompareSide other = *resolve_sides(input_of(runs), {}).a;
        auto changed = std::make_shared<PublishedFrame>(*frame);
        change(*changed);
        show_newer(other, changed);
        return other.frame == nullptr;
    };
    CHECK(refused([](PublishedFrame& f) { f.divider = 2; }));
    CHECK(refused([](PublishedFrame& f) { f.backend.name = "cuda"; }));
    CHECK(refused([](PublishedFrame& f) { f.snapshot.slot.method = MethodId::Default; }));
    CHECK(refused([](PublishedFrame& f) { f.snapshot.slot.view = View::Normal; }));
    CHECK(refused([](PublishedFrame& f) { f.snapshot.width = 8; }));
    CompareSide finished = *resolve_sides(input_of(runs), {}).b;
    show_newer(finished, frame);
    CHECK(finished.frame == nullptr);
}
