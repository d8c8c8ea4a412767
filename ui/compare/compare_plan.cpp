#include "ui/compare/compare_plan.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "ui/draw/method_keys.h"

namespace pl {
namespace {

using What = TileContent::What;

bool has_pixels(const std::optional<CompareSide>& side) { return side && (side->picture || side->frame); }

TileContent content_of(const CompareSide& side) {
    if (side.frame) return {.what = What::Frame, .picture = {}, .other = {}, .frame = side.frame};
    return {.what = What::Picture, .picture = side.picture, .other = {}, .frame = {}};
}

Rect place_of(const TileContent& content, const Rect& view) {
    if (content.frame) return place_image(view, content.frame->snapshot.width, content.frame->snapshot.height);
    return place_image(view, content.picture->width, content.picture->height);
}

CompareTile whole_tile(TileContent content, const CompareSide& side, const Rect& view) {
    const Rect place = place_of(content, view);
    return {std::move(content), place, place, side.label, side.color, false};
}

/// Cuts two tiles in the same place; the first lies left of the line.
void split_tiles(ComparePlan& plan, float share) {
    CompareTile& left = plan.tiles[0];
    CompareTile& right = plan.tiles[1];
    const float x = std::round(left.place.x + std::clamp(share, 0.0f, 1.0f) * left.place.width);
    left.clip.width = x - left.place.x;
    right.clip.x = x;
    right.clip.width = right.place.x + right.place.width - x;
    right.label_right = true;
    plan.split_x = x;
}

void plan_split(ComparePlan& plan, const CompareSides& sides, const CompareState& state, const Rect& view) {
    plan.tiles = {whole_tile(content_of(*sides.a), *sides.a, view), whole_tile(content_of(*sides.b), *sides.b, view)};
    split_tiles(plan, state.split);
}

void plan_side_by_side(ComparePlan& plan, const CompareSides& sides, const Rect& view) {
    const float half = std::floor(0.5f * view.width);
    const Rect left{view.x, view.y, half, view.height};
    const Rect right{view.x + half, view.y, view.width - half, view.height};
    plan.tiles = {whole_tile(content_of(*sides.a), *sides.a, left),
                  whole_tile(content_of(*sides.b), *sides.b, right)};
    plan.at_image = false;
}

void plan_difference(ComparePlan& plan, const CompareSides& sides, const Rect& view) {
    if (!sides.fit_together()) {
        plan.hint = "the difference needs two stored pictures";
        return;
    }
    const TileContent content{
        .what = What::Difference, .picture = sides.a->picture, .other = sides.b->picture, .frame = {}};
    CompareTile tile = whole_tile(content, *sides.a, view);
    tile.label = "|A - B|  A: " + sides.a->label + "   B: " + sides.b->label;
    tile.color = 0xffe4e6eau;
    plan.tiles = {std::move(tile)};
}

bool can_be_scored(const std::optional<CompareSide>& side, const HalfPicture& reference) {
    return side && !side->is_reference && side->picture && side->picture->width == reference.width &&
           side->picture->height == reference.height;
}

void plan_error_map(ComparePlan& plan, const CompareSides& sides, const CompareState& state,
                    const ReferencePicture* reference, const Rect& view) {
    if (reference == nullptr || !reference->pixels) {
        plan.hint = "the error map needs a reference of this picture";
        return;
    }
    for (const auto* side : {&sides.a, &sides.b}) {
        if (!can_be_scored(*side, *reference->pixels)) continue;
        const TileContent content{
            .what = What::ErrorMap, .picture = (*side)->picture, .other = reference->pixels, .frame = {}};
        plan.tiles.push_back(whole_tile(content, **side, view));
    }
    if (plan.tiles.empty()) plan.hint = "the error map needs a stored picture of a run";
    if (plan.tiles.size() == 2) split_tiles(plan, state.split);
    plan.has_heat = !plan.tiles.empty();
}

/// Modes that need both sides, with only one or none.
void plan_incomplete(ComparePlan& plan, const CompareSides& sides, const Rect& view) {
    for (const auto* side : {&sides.a, &sides.b})
        if (plan.tiles.empty() && has_pixels(*side)) plan.tiles = {whole_tile(content_of(**side), **side, view)};
    for (const auto* side : {&sides.a, &sides.b})
        if (*side && !has_pixels(*side)) plan.hint += (plan.hint.empty() ? "" : "; ") + (*side)->label;
    if (plan.hint.empty())
        plan.hint = fmt::format("nothing to compare with yet: {} render with other methods", method_keys());
}

}  // namespace

ComparePlan plan_comparison(const CompareSides& sides, const CompareState& state, const ReferencePicture* reference,
                            const Rect& view) {
    ComparePlan plan;
    if (state.mode == CompareMode::Off) return plan;
    const bool both = has_pixels(sides.a) && has_pixels(sides.b);
    if (state.mode == CompareMode::ErrorMap) {
        plan_error_map(plan, sides, state, reference, view);
    } else if (!both) {
        plan_incomplete(plan, sides, view);
    } else if (state.mode == CompareMode::Difference) {
        plan_difference(plan, sides, view);
    } else if (state.mode == CompareMode::SideBySide) {
        plan_side_by_side(plan, sides, view);
    } else if (state.mode == CompareMode::Split) {
        plan_split(plan, sides, state, view);
    } else {
        const CompareSide& shown = state.shows_second ? *sides.b : *sides.a;
        plan.tiles = {whole_tile(content_of(shown), shown, view)};
        plan.tiles[0].label_right = state.shows_second;
    }
    return plan;
}

}  // namespace pl
