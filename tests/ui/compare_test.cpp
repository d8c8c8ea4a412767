// Which two pictures are compared, where they are drawn, and with which pixels; and whose turn it is.
#include <cmath>

#include "core/kernel/base/half.h"
#include "core/kernel/film/frame_pixel.h"
#include "tests/support/catch.hpp"
#include "tests/ui/hand_made_runs.h"
#include "ui/compare/compare_plan.h"
#include "ui/compare/half_image.h"
#include "ui/compare/turns.h"

using namespace pl;
using namespace pl::test;

namespace {

constexpr Rect kView{10.0f, 20.0f, 400.0f, 200.0f};  // a picture of 4 x 2 fills it

ReferencePicture reference_of(std::uint64_t picture = kThisPicture) {
    return {.picture = picture, .pixels = plain_picture(0x3c00), .label = "reference", .noise_relmse = 1e-4};
}

CompareInput input_of(const Runs& runs, const ReferencePicture* reference = nullptr, Cursor cursor = {}) {
    return {.runs = runs, .picture = kThisPicture, .kind = {}, .cursor = cursor, .reference = reference};
}

CompareState state_of(CompareMode mode) {
    CompareState state;
    state.mode = mode;
    return state;
}

/// The pixels of a plain picture of one half float, as written.
std::uint32_t shown(std::uint16_t half, const DisplaySettings& display) {
    std::uint32_t out[8] = {};
    write_half_picture(*plain_picture(half), HalfCodes(display), out, 4);
    return out[7];
}

}  // namespace

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
    // Coarse ones, and those of others, are not.
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

TEST_CASE("Stored pictures: exposure and curve apply to them as to frames") {
    for (const ToneCurve curve : {ToneCurve::Clamp, ToneCurve::Reinhard, ToneCurve::Aces})
        for (const float ev : {-2.0f, 0.0f, 3.0f}) {
            const DisplaySettings display{.exposure_ev = ev, .curve = curve};
            const ToneTable table(curve);
            const FrameStyle style{.scale = std::exp2(ev), .curve = curve};
            for (const std::uint16_t half : std::array<std::uint16_t, 5>{0x0000, 0x2e66, 0x3800, 0x3c00, 0x4d00})
                CHECK(shown(half, display) == frame_pixel(Vec3f{from_half(half)}, style, table.view()));
        }
    CHECK(shown(0x7e00, {}) == kInvalidPixel);
}

TEST_CASE("Difference: equal pictures are black, the sign does not matter") {
    std::uint32_t ab[8], ba[8], aa[8];
    const auto a = plain_picture(0x3c00), b = plain_picture(0x3800);  // 1 and 0.5
    write_difference(*a, *b, {}, ab, 4);
    write_difference(*b, *a, {}, ba, 4);
    write_difference(*a, *a, {}, aa, 4);
    CHECK(ab[3] == ba[3]);
    CHECK(ab[3] == shown(0x3800, {}));
    CHECK(aa[3] == 0xff000000u);
}

TEST_CASE("Error map: a pixel counts as in relMSE, and colors follow its logarithm") {
    // (1.5 - 1)^2 / (1 + 0.01)
    CHECK_THAT(pixel_error(Vec3f{1.5f}, Vec3f{1.0f}), WithinRel(std::sqrt(0.25 / 1.01), 1e-6));
    CHECK(pixel_error(Vec3f{1.0f}, Vec3f{1.0f}) == 0.0f);
    CHECK(std::isnan(pixel_error(Vec3f{NAN}, Vec3f{1.0f})));
    std::uint32_t same[8], off[8], invalid[8];
    write_error_map(*plain_picture(0x3c00), *plain_picture(0x3c00), same, 4);
    write_error_map(*plain_picture(0x5000), *plain_picture(0x3c00), off, 4);  // 32: more than the scale holds
    write_error_map(*plain_picture(0x7e00), *plain_picture(0x3c00), invalid, 4);
    const auto color = [](float share) {
        const ByteColor c = heat_color(share);
        return pack_pixel(c.r, c.g, c.b);
    };
    CHECK(same[0] == color(0.0f));
    CHECK(off[0] == color(1.0f));
    CHECK(invalid[0] == kInvalidPixel);
}

TEST_CASE("Turns: short passes go A, B, B, A in turns of equal time") {
    Turns turns(0.25);
    std::array<double, 2> charged{};
    std::vector<std::size_t> order;
    for (int pass = 0; pass < 400; ++pass) {
        const std::size_t side = turns.next(charged);
        if (order.empty() || order.back() != side) order.push_back(side);
        charged[side] += 0.01;
        CHECK(std::fabs(charged[0] - charged[1]) <= 0.5 + 0.011);
    }
    // Neighboring turns of one side look like one.
    CHECK((std::vector<std::size_t>(order.begin(), order.begin() + 6) == std::vector<std::size_t>{0, 1, 0, 1, 0, 1}));
    CHECK_FALSE(turns.catching_up());
}

TEST_CASE("Turns: passes longer than a turn are paid for with later turns") {
    Turns turns(0.25);
    std::array<double, 2> charged{};
    std::array<int, 2> passes{};
    for (int pass = 0; pass < 1000; ++pass) {
        const std::size_t side = turns.next(charged);
        charged[side] += side == 0 ? 1.7 : 0.03;
        ++passes[side];
        REQUIRE(std::fabs(charged[0] - charged[1]) <= 0.5 + 1.71);
    }
    CHECK(passes[0] > 10);
    CHECK_THAT(static_cast<double>(passes[1]) / passes[0], WithinRel(1.7 / 0.03, 0.2));
}

TEST_CASE("Turns: the side that is behind catches up first, also when one starts over") {
    Turns turns(0.25);
    std::array<double, 2> charged{5.0, 0.0};
    while (charged[1] < 5.0) {
        REQUIRE(turns.next(charged) == 1);
        CHECK(turns.catching_up());
        charged[1] += 0.1;
    }
    (void)turns.next(charged);
    CHECK_FALSE(turns.catching_up());
    charged = {6.0, 0.02};  // its picture was emptied
    CHECK(turns.next(charged) == 1);
    CHECK(turns.catching_up());
    charged = {0.0, 0.0};
    CHECK(turns.next(charged) == 0);
    CHECK_FALSE(turns.catching_up());
}
