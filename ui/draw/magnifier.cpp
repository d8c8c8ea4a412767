#include "ui/draw/magnifier.h"

#include <algorithm>
#include <cmath>

namespace pl::ui {

Magnifier make_magnifier(const Rect& image, Vec2f pointer, int width, int height, const Rect& view, float em) {
    // Twice the picture's, as far as the box stays handy.
    const float twice = 2.0f * std::ceil(image.width / static_cast<float>(width));
    const float step = std::max(std::floor(0.9f * em), std::min(twice, std::floor(1.5f * em)));
    const float side = step * static_cast<float>(Magnifier::kPixels);
    const float apart = 1.5f * em;
    const auto beside = [&](float at, float low, float high) {
        const bool has_room = at + apart + side <= high;
        return std::floor(has_room ? at + apart : std::max(at - apart - side, low));
    };
    Magnifier magnifier;
    magnifier.source = image;
    magnifier.box = {beside(pointer.x, view.x, view.x + view.width), beside(pointer.y, view.y, view.y + view.height),
                     side, side};
    magnifier.pixel = pixel_under(image, pointer, width, height);
    const float before = step * static_cast<float>(Magnifier::kPixels / 2);
    magnifier.middle = {magnifier.box.x + before, magnifier.box.y + before, step, step};
    magnifier.image = {magnifier.middle.x - step * static_cast<float>(magnifier.pixel.x),
                       magnifier.middle.y - step * static_cast<float>(magnifier.pixel.y),
                       step * static_cast<float>(width), step * static_cast<float>(height)};
    return magnifier;
}

}  // namespace pl::ui
