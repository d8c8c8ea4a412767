#include "ui/compare/pointed_pixel.h"

namespace pl::ui {
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
