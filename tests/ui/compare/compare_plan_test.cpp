// The rectangles of a comparison.
// The pixel under the pointer, and compared pictures under a zoom.
#include "ui/compare/compare_plan.h"

#include <algorithm>
#include <cmath>

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
        const auto places = picture_places(plan, {}, kView);
        REQUIRE(places.size() == 1);
        CHECK(places[0].clip.width == 400.0f);
        CHECK(place_under(places, {left.place.x + 1.0f, left.place.center().y}).x == left.place.x);
    }
}

TEST_CASE("Plan: flip shows one at a time, side by side both whole, each under its own pointer") {
    const Runs runs = two_runs();
    CompareState state = state_of(CompareMode::Flip);
    const CompareSides sides = resolve_sides(input_of(runs), state);
    CHECK(plan_comparison(sides, state, nullptr, kView).tiles.at(0).label == sides.a->label);
    state.shows_second = true;
    CHECK(plan_comparison(sides, state, nullptr, kView).tiles.at(0).label == sides.b->label);
    const ComparePlan both = plan_comparison(sides, state_of(CompareMode::SideBySide), nullptr, kView);
    REQUIRE(both.tiles.size() == 2);
    CHECK(both.tiles[0].place.x + both.tiles[0].place.width <= both.tiles[1].place.x);
    const auto places = picture_places(both, {}, kView);
    REQUIRE(places.size() == 2);
    for (const std::size_t tile : {0u, 1u})
        CHECK(place_under(places, both.tiles[tile].place.center()).x == both.tiles[tile].place.x);
    // A picture of another shape, from a file, shows another view: nothing of this one lies over it.
    CHECK(picture_places(both, {0.0f, 0.0f, 100.0f, 50.0f}, kView).size() == 2);
    ComparePlan other = both;
    other.tiles[1].place.height *= 0.5f;
    CHECK(picture_places(other, {0.0f, 0.0f, 100.0f, 50.0f}, kView).size() == 1);
    CHECK(place_under(places, {kView.x + 1.0f, kView.y + 1.0f}).width == 0.0f);
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

TEST_CASE("Plan: a picture of display values is shown as it is, and neither measured nor subtracted") {
    const Runs runs = two_runs();
    CompareSides sides = resolve_sides(input_of(runs), {});
    sides.b->is_display = true;
    const ComparePlan split = plan_comparison(sides, state_of(CompareMode::Split), nullptr, kView);
    REQUIRE(split.tiles.size() == 2);
    CHECK_FALSE(split.tiles[0].content.is_display);
    CHECK(split.tiles[1].content.is_display);
    CHECK(value_of(split.tiles[0].content, {0, 0}));
    CHECK_FALSE(value_of(split.tiles[1].content, {0, 0}));
    const ComparePlan difference = plan_comparison(sides, state_of(CompareMode::Difference), nullptr, kView);
    CHECK(difference.tiles.empty());
    CHECK_THAT(difference.hint, contains("linear values"));
    const ReferencePicture reference = reference_of();
    CHECK(plan_comparison(sides, state_of(CompareMode::ErrorMap), &reference, kView).tiles.size() == 1);
}

namespace {

/// 4 x 2 pixels, each with its number as red.
PublishedFrame numbered_frame() {
    PublishedFrame frame;
    frame.snapshot.width = 4;
    frame.snapshot.height = 2;
    for (int i = 0; i < 8; ++i) frame.snapshot.pixels.emplace_back(static_cast<float>(i), 0.0f, 0.0f);
    return frame;
}

PictureZoom twice() {
    PictureZoom zoom;
    zoom.step(1, kView.center(), kView, 4, 2);
    return zoom;
}

}  // namespace

TEST_CASE("Pointed pixel: place and value of the picture, none beside it or without values") {
    PublishedFrame frame = numbered_frame();
    const auto pointed = pointed_pixel({}, frame, kView, {10.0f + 250.0f, 20.0f + 150.0f});
    REQUIRE(pointed);
    CHECK(pointed->at == PixelPosition{2, 1});
    CHECK(pointed->value->x == 6.0f);
    CHECK_FALSE(pointed_pixel({}, frame, kView, {5.0f, 100.0f}));
    CHECK(magnifier_at({}, frame, kView, {260.0f, 170.0f}, kView, 16.0f)->pixel == PixelPosition{2, 1});
    frame.snapshot.pixels.clear();
    CHECK_FALSE(pointed_pixel({}, frame, kView, {260.0f, 170.0f})->value);
}

TEST_CASE("Pointed pixel: of the compared picture under the pointer") {
    const Runs runs = two_runs();
    const CompareState state = state_of(CompareMode::SideBySide);
    const CompareSides sides = resolve_sides(input_of(runs), state);
    const ComparePlan plan = plan_comparison(sides, state, nullptr, kView);
    for (const CompareTile& tile : plan.tiles) {
        const auto pointed = pointed_pixel(plan, numbered_frame(), kView, tile.clip.center());
        REQUIRE(pointed);
        CHECK(*pointed->value == *value_of(tile.content, pointed->at));
    }
    CHECK_FALSE(pointed_pixel(plan, numbered_frame(), kView, {11.0f, 21.0f}));  // above the smaller pictures
}

TEST_CASE("Zoom: compared pictures keep one place, are cut at the view, and the line follows the picture") {
    const Runs runs = two_runs();
    CompareState state = state_of(CompareMode::Split);
    const CompareSides sides = resolve_sides(input_of(runs), state);
    PictureZoom zoom = twice();
    for (const float share : {0.0f, 0.5f, 0.6f, 1.0f}) {
        state.split = share;
        const ComparePlan plan = plan_comparison(sides, state, nullptr, kView, zoom);
        REQUIRE(plan.tiles.size() == 2);
        const Rect place = zoom.place(kView, 4, 2);
        CHECK(plan.is_zoomed);
        for (const CompareTile& tile : plan.tiles) {
            CHECK(tile.place.x == place.x);
            CHECK(tile.place.width == place.width);
            CHECK(tile.clip.x >= kView.x);
            CHECK(tile.clip.x + tile.clip.width <= kView.x + kView.width);
        }
        CHECK(plan.tiles[0].clip.x + plan.tiles[0].clip.width == plan.tiles[1].clip.x);
        const float line = std::round(place.x + share * place.width);
        CHECK(*plan.split_x == std::clamp(line, kView.x, kView.x + kView.width));
    }
}
