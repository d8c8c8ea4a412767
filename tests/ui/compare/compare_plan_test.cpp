// The rectangles of a comparison.
#include "tests/support/catch.hpp"
#include "tests/ui/hand_made_comparison.h"

using namespace pl;
using namespace pl::ui;
using namespace pl::test;

TEST_CASE("Plan: off draws nothing, nothing to compare says so") {
    CHECK(plan_comparison({}, state_of(CompareMode::Off), nullptr, kView).tiles.empty());
    for (const CompareMode mode : {CompareMode::Split, CompareMode::Flip, CompareMode::SideBySide,
                                   CompareMode::Difference, CompareMode::ErrorMap}) {
        const ComparePlan plan = plan_comparison({}, state_of(mode), nullptr, kView);
        CHECK(plan.tiles.empty());
        CHECK_FALSE(plan.hint.empty());
    }
}

TEST_CASE("Plan: a split shows the parts of two pictures that lie in the same place") {
    const Runs runs = two_runs();
    CompareState state = state_of(CompareMode::Split);
    for (const float share : {0.0f, 0.3f, 1.0f}) {
        state.split = share;
        const ComparePlan plan = plan_comparison(resolve_sides(input_of(runs), state), state, nullptr, kView);
        REQUIRE(plan.tiles.size() == 2);
        const CompareTile& left = plan.tiles[0];
        const CompareTile& right = plan.tiles[1];
        CHECK(left.place.x == right.place.x);
        CHECK_THAT(left.clip.width, WithinAbs(400.0 * share, 1e-3));
        CHECK(left.clip.x + left.clip.width == right.clip.x);
        CHECK(left.clip.width + right.clip.width == 400.0f);
        CHECK_THAT(*plan.split_x, WithinAbs(10.0 + 400.0 * share, 1e-3));
        CHECK(plan.at_image);
    }
}

TEST_CASE("Plan: flip shows one at a time, side by side both whole and away from the image") {
    const Runs runs = two_runs();
    CompareState state = state_of(CompareMode::Flip);
    const CompareSides sides = resolve_sides(input_of(runs), state);
    CHECK(plan_comparison(sides, state, nullptr, kView).tiles.at(0).label == sides.a->label);
    state.shows_second = true;
    CHECK(plan_comparison(sides, state, nullptr, kView).tiles.at(0).label == sides.b->label);
    const ComparePlan both = plan_comparison(sides, state_of(CompareMode::SideBySide), nullptr, kView);
    REQUIRE(both.tiles.size() == 2);
    CHECK(both.tiles[0].place.x + both.tiles[0].place.width <= both.tiles[1].place.x);
    CHECK_FALSE(both.at_image);
}

TEST_CASE("Plan: difference and error map need pictures of the same size, the map a reference") {
    const Runs runs = two_runs();
    CompareSides sides = resolve_sides(input_of(runs), {});
    const ComparePlan difference = plan_comparison(sides, state_of(CompareMode::Difference), nullptr, kView);
    REQUIRE(difference.tiles.size() == 1);
    CHECK(difference.tiles[0].content.what == TileContent::What::Difference);
    const ComparePlan none = plan_comparison(sides, state_of(CompareMode::ErrorMap), nullptr, kView);
    CHECK(none.tiles.empty());
    CHECK_THAT(none.hint, contains("needs a reference"));
    ReferencePicture reference = reference_of();
    const ComparePlan map = plan_comparison(sides, state_of(CompareMode::ErrorMap), &reference, kView);
    CHECK(map.tiles.size() == 2);
    CHECK(map.has_heat);
    reference.pixels = plain_picture(0x3c00, 8, 4);
    CHECK(plan_comparison(sides, state_of(CompareMode::ErrorMap), &reference, kView).tiles.empty());
    sides.b->picture = plain_picture(0x3c00, 8, 4);
    CHECK(plan_comparison(sides, state_of(CompareMode::Difference), nullptr, kView).tiles.empty());
}
