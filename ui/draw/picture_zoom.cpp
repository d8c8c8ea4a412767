#include "ui/draw/picture_zoom.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pl::ui {
namespace {

constexpr std::array kScales{1.0f,  2.0f,  3.0f,  4.0f,  6.0f,  8.0f,  12.0f,
                             16.0f, 24.0f, 32.0f, 48.0f, 64.0f, 96.0f, PictureZoom::kLargest};

/// Cuts of one axis at the pixels that the visible part cuts: pixels [from, to) at [low, high) of the window.
struct AxisPart {
    int from;
    int to;
    float low;
    float high;
};

std::vector<AxisPart> spans_of(float start, float length, float low, float high, int pixels) {
    const float step = length / static_cast<float>(pixels);
    const auto edge = [&](int pixel) { return start + step * static_cast<float>(pixel); };
    const auto pixel_at = [&](float at) {
        return std::clamp(static_cast<int>(std::floor((at - start) / step)), 0, pixels - 1);
    };
    const int first = pixel_at(low);
    const int last = pixel_at(std::nextafter(high, low));
    if (first == last) return {{first, first + 1, low, high}};
    std::vector<AxisPart> spans{{first, first + 1, low, edge(first + 1)}};
    if (first + 1 < last) spans.push_back({first + 1, last, edge(first + 1), edge(last)});
    spans.push_back({last, last + 1, edge(last), high});
    return spans;
}

}  // namespace

Rect common_part(const Rect& a, const Rect& b) {
    const float x = std::max(a.x, b.x);
    const float y = std::max(a.y, b.y);
    return {x, y, std::max(std::min(a.x + a.width, b.x + b.width) - x, 0.0f),
            std::max(std::min(a.y + a.height, b.y + b.height) - y, 0.0f)};
}

PixelPosition pixel_under(const Rect& image, Vec2f window, int width, int height) {
    const Vec2f at = picture_point(image, window);
    const auto pixel = [](float share, int size) {
        return std::clamp(static_cast<int>(std::floor(share * static_cast<float>(size))), 0, size - 1);
    };
    return {pixel(at.x, width), pixel(at.y, height)};
}

Rect pixel_place(const Rect& image, PixelPosition pixel, int width, int height) {
    const float across = image.width / static_cast<float>(width);
    const float down = image.height / static_cast<float>(height);
    return {image.x + across * static_cast<float>(pixel.x), image.y + down * static_cast<float>(pixel.y), across,
            down};
}

std::vector<PictureSlice> visible_slices(const Rect& image, const Rect& clip, int width, int height) {
    const Rect seen = common_part(image, clip);
    std::vector<PictureSlice> slices;
    if (width < 1 || height < 1 || !(seen.width > 0.0f) || !(seen.height > 0.0f)) return slices;
    const auto columns = spans_of(image.x, image.width, seen.x, seen.x + seen.width, width);
    const auto rows = spans_of(image.y, image.height, seen.y, seen.y + seen.height, height);
    for (const AxisPart& row : rows)
        for (const AxisPart& column : columns)
            slices.push_back({column.from, row.from, column.to - column.from, row.to - row.from,
                              Rect{column.low, row.low, column.high - column.low, row.high - row.low}});
    return slices;
}

Rect PictureZoom::place(const Rect& view, int width, int height) const {
    if (is_whole() || width < 1 || height < 1) return place_image(view, width, height);
    const Vec2f size{scale_ * static_cast<float>(width), scale_ * static_cast<float>(height)};
    const Vec2f corner = view.center() - center_ * size;
    return {std::round(corner.x), std::round(corner.y), size.x, size.y};  // pixels begin at whole window pixels
}

void PictureZoom::step(int notches, Vec2f pointer, const Rect& view, int width, int height) {
    if (notches == 0 || width < 1 || height < 1) return;
    const float fit = place_image(view, width, height).width / static_cast<float>(width);
    float scale = is_whole() ? fit : scale_;
    for (int i = 0; i < std::abs(notches); ++i) {
        if (notches > 0) {
            const auto next = std::ranges::upper_bound(kScales, scale);
            scale = next != kScales.end() ? *next : kLargest;
        } else {
            const auto next = std::ranges::lower_bound(kScales, scale);
            scale = next != kScales.begin() ? *std::prev(next) : fit;
        }
    }
    if (scale <= fit)
        reset();
    else
        set_scale(scale, pointer, view, width, height);
}

void PictureZoom::toggle(Vec2f pointer, const Rect& view, int width, int height) {
    if (!is_whole()) return reset();
    const float fit = place_image(view, width, height).width / static_cast<float>(std::max(width, 1));
    const auto next = std::ranges::upper_bound(kScales, fit);
    set_scale(fit < 1.0f ? 1.0f : (next != kScales.end() ? *next : kLargest), pointer, view, width, height);
}

void PictureZoom::set_scale(float scale, Vec2f pointer, const Rect& view, int width, int height) {
    const Vec2f under = picture_point(place(view, width, height), pointer);
    scale_ = scale;
    const Vec2f size{scale * static_cast<float>(width), scale * static_cast<float>(height)};
    center_ = glm::clamp(under - (pointer - view.center()) / size, 0.0f, 1.0f);
}

void PictureZoom::pan(Vec2f pixels, int width, int height) {
    if (is_whole()) return;
    const Vec2f size{scale_ * static_cast<float>(width), scale_ * static_cast<float>(height)};
    center_ = glm::clamp(center_ - pixels / size, 0.0f, 1.0f);
}

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
