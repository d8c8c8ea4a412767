#include "ui/compare/compare_plan.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "ui/compare/half_image.h"
#include "ui/draw/value_text.h"

namespace pl::ui {
namespace {

using What = TileContent::What;

bool has_pixels(const std::optional<CompareSide>& side) { return side && (side->picture || side->frame); }

TileContent content_of(const CompareSide& side) {
    if (side.frame) return {.what = What::Frame, .picture = {}, .other = {}, .frame = side.frame};
    return {.what = What::Picture, .picture = side.picture, .other = {}, .frame = {}, .is_display = side.is_display};
}

/// The room of a picture, and how much of it is shown there.
struct Stage {
    Rect view;
    PictureZoom zoom;
};

Rect place_of(const TileContent& content, const Stage& stage) {
    const auto place = [&](const auto& picture) {
        return stage.zoom.place(stage.view, picture.width, picture.height);
    };
    return content.frame ? place(content.frame->snapshot) : place(*content.picture);
}

CompareTile whole_tile(TileContent content, const CompareSide& side, const Stage& stage) {
    const Rect place = place_of(content, stage);
    return {std::move(content), place, common_part(place, stage.view), side.label, side.color, false};
}

/// Cuts two tiles in the same place; the first lies left of the line.
void split_tiles(ComparePlan& plan, float share) {
    CompareTile& left = plan.tiles[0];
    CompareTile& right = plan.tiles[1];
    const Rect& seen = left.clip;
    const float line = std::round(left.place.x + std::clamp(share, 0.0f, 1.0f) * left.place.width);
    const float x = std::clamp(line, seen.x, seen.x + seen.width);  // within reach of the pointer
    right.clip.width = right.clip.x + right.clip.width - x;
    right.clip.x = x;
    left.clip.width = x - left.clip.x;
    right.label_right = true;
    plan.split_x = x;
}

void plan_split(ComparePlan& plan, const CompareSides& sides, const CompareState& state, const Stage& stage) {
    plan.tiles = {whole_tile(content_of(*sides.a), *sides.a, stage),
                  whole_tile(content_of(*sides.b), *sides.b, stage)};
    split_tiles(plan, state.split);
}

void plan_side_by_side(ComparePlan& plan, const CompareSides& sides, const Stage& stage) {
    const Rect& view = stage.view;
    const float half = std::floor(0.5f * view.width);
    const Stage left{{view.x, view.y, half, view.height}, stage.zoom};
    const Stage right{{view.x + half, view.y, view.width - half, view.height}, stage.zoom};
    plan.tiles = {whole_tile(content_of(*sides.a), *sides.a, left),
                  whole_tile(content_of(*sides.b), *sides.b, right)};
}

void plan_difference(ComparePlan& plan, const CompareSides& sides, const Stage& stage) {
    if (!sides.fit_together()) {
        plan.hint = "the difference needs two stored pictures of one size with linear values";
        return;
    }
    const TileContent content{
        .what = What::Difference, .picture = sides.a->picture, .other = sides.b->picture, .frame = {}};
    CompareTile tile = whole_tile(content, *sides.a, stage);
    tile.label = "|A - B|  A: " + sides.a->label + "   B: " + sides.b->label;
    tile.color = 0xffe4e6eau;
    plan.tiles = {std::move(tile)};
}

bool can_be_scored(const std::optional<CompareSide>& side, const HalfPicture& reference) {
    return side && !side->is_reference && !side->is_display && side->picture &&
           side->picture->width == reference.width && side->picture->height == reference.height;
}

void plan_error_map(ComparePlan& plan, const CompareSides& sides, const CompareState& state,
                    const ReferencePicture* reference, const Stage& stage) {
    if (reference == nullptr || !reference->pixels) {
        plan.hint = "the error map needs a reference: Ctrl+R renders one";
        return;
    }
    for (const auto* side : {&sides.a, &sides.b}) {
        if (!can_be_scored(*side, *reference->pixels)) continue;
        const TileContent content{
            .what = What::ErrorMap, .picture = (*side)->picture, .other = reference->pixels, .frame = {}};
        plan.tiles.push_back(whole_tile(content, **side, stage));
    }
    if (plan.tiles.empty()) plan.hint = "the error map needs a stored picture of a run";
    if (plan.tiles.size() == 2) split_tiles(plan, state.split);
    plan.has_heat = !plan.tiles.empty();
}

/// Modes that need both sides, with only one or none.
void plan_incomplete(ComparePlan& plan, const CompareSides& sides, const Stage& stage) {
    for (const auto* side : {&sides.a, &sides.b})
        if (plan.tiles.empty() && has_pixels(*side)) plan.tiles = {whole_tile(content_of(**side), **side, stage)};
    for (const auto* side : {&sides.a, &sides.b})
        if (*side && !has_pixels(*side)) plan.hint += (plan.hint.empty() ? "" : "; ") + (*side)->label;
    if (plan.hint.empty())
        plan.hint = fmt::format("nothing to compare with yet: {} render with other methods", method_keys());
}

std::size_t index_of(PixelPosition pixel, int width) {
    return static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(pixel.x);
}

}  // namespace

ComparePlan plan_comparison(const CompareSides& sides, const CompareState& state, const ReferencePicture* reference,
                            const Rect& view, const PictureZoom& zoom) {
    const Stage stage{view, zoom};
    ComparePlan plan;
    if (state.mode == CompareMode::Off) return plan;
    plan.is_zoomed = !zoom.is_whole();
    const bool both = has_pixels(sides.a) && has_pixels(sides.b);
    if (state.mode == CompareMode::ErrorMap) {
        plan_error_map(plan, sides, state, reference, stage);
    } else if (!both) {
        plan_incomplete(plan, sides, stage);
    } else if (state.mode == CompareMode::Difference) {
        plan_difference(plan, sides, stage);
    } else if (state.mode == CompareMode::SideBySide) {
        plan_side_by_side(plan, sides, stage);
    } else if (state.mode == CompareMode::Split) {
        plan_split(plan, sides, state, stage);
    } else {
        const CompareSide& shown = state.shows_second ? *sides.b : *sides.a;
        plan.tiles = {whole_tile(content_of(shown), shown, stage)};
        plan.tiles[0].label_right = state.shows_second;
    }
    return plan;
}

std::vector<PicturePlace> picture_places(const ComparePlan& plan, const Rect& image, const Rect& view) {
    if (plan.tiles.empty()) return {{image, common_part(image, view)}};
    constexpr float kSame = 0.05f;  // places are rounded to pixels
    std::vector<PicturePlace> places;
    for (const CompareTile& tile : plan.tiles) {
        const float area = tile.place.width * image.height;
        if (std::fabs(area - tile.place.height * image.width) > kSame * area) continue;
        const bool is_new = places.empty() || places.back().place.x != tile.place.x;
        if (is_new)
            places.push_back({tile.place, tile.clip});
        else  // beside the other part
            places.back().clip.width = tile.clip.x + tile.clip.width - places.back().clip.x;
    }
    return places;
}

Rect place_under(const std::vector<PicturePlace>& places, Vec2f pointer) {
    for (const PicturePlace& place : places)
        if (place.clip.contains(pointer)) return place.place;
    return {};
}

std::optional<Vec3f> value_of(const PublishedFrame& frame, PixelPosition pixel) {
    if (!frame.has_values()) return std::nullopt;
    return frame.snapshot.pixels[index_of(pixel, frame.snapshot.width)];
}

std::optional<Vec3f> value_of(const TileContent& content, PixelPosition pixel) {
    if (content.frame) return value_of(*content.frame, pixel);
    if (content.is_display) return std::nullopt;
    const std::size_t index = index_of(pixel, content.picture->width);
    const Vec3f value = pixel_of(*content.picture, index);
    if (content.what == What::Picture) return value;
    const Vec3f other = pixel_of(*content.other, index);
    return content.what == What::Difference ? glm::abs(value - other) : Vec3f{pixel_error(value, other)};
}

namespace {

/// A picture in the window, with its number of pixels.
struct ShownPicture {
    Rect image;
    int width = 0;
    int height = 0;
    const TileContent* tile = nullptr;  ///< null: the frame
};

std::optional<ShownPicture> picture_under(const ComparePlan& plan, const PublishedFrame& frame, const Rect& image,
                                          Vec2f pointer) {
    for (const CompareTile& tile : plan.tiles) {
        if (!tile.clip.contains(pointer)) continue;
        const TileContent& content = tile.content;
        const int width = content.frame ? content.frame->snapshot.width : content.picture->width;
        const int height = content.frame ? content.frame->snapshot.height : content.picture->height;
        return ShownPicture{tile.place, width, height, &content};
    }
    if (!plan.tiles.empty() || !image.contains(pointer)) return std::nullopt;
    return ShownPicture{image, frame.snapshot.width, frame.snapshot.height};
}

}  // namespace

std::optional<PointedPixel> pointed_pixel(const ComparePlan& plan, const PublishedFrame& frame, const Rect& image,
                                          Vec2f pointer) {
    const auto picture = picture_under(plan, frame, image, pointer);
    if (!picture) return std::nullopt;
    PointedPixel pointed{.at = pixel_under(picture->image, pointer, picture->width, picture->height)};
    pointed.value = picture->tile != nullptr ? value_of(*picture->tile, pointed.at) : value_of(frame, pointed.at);
    return pointed;
}

std::optional<Magnifier> magnifier_at(const ComparePlan& plan, const PublishedFrame& frame, const Rect& image,
                                      Vec2f pointer, const Rect& view, float em) {
    const auto picture = picture_under(plan, frame, image, pointer);
    if (!picture) return std::nullopt;
    return make_magnifier(picture->image, pointer, picture->width, picture->height, view, em);
}

}  // namespace pl::ui
