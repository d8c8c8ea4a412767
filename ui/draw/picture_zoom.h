// The place of the picture in the window, zoomed or whole, and the one mapping between points of the window and of the picture.
#pragma once

#include <optional>
#include <vector>

#include "ui/draw/layout.h"

namespace pl::ui {

/// The common part of two rectangles; empty rectangles have a width or height of 0.
Rect common_part(const Rect& a, const Rect& b);

/// A pixel of a picture, from its top left corner.
struct PixelPosition {
    int x = 0;
    int y = 0;

    friend bool operator==(const PixelPosition&, const PixelPosition&) = default;
};

/// The pixel under the pointer.
struct PointedPixel {
    PixelPosition at;
    std::optional<Vec3f> value{};  ///< linear; empty if its picture has no values
};

/// The point of the picture, in [0,1)^2 from the top left, under a point of the window. `image` is the rectangle of the whole
/// picture in the window.
inline Vec2f picture_point(const Rect& image, Vec2f window) {
    return {(window.x - image.x) / image.width, (window.y - image.y) / image.height};
}
/// The inverse.
inline Vec2f window_point(const Rect& image, Vec2f picture) {
    return {image.x + picture.x * image.width, image.y + picture.y * image.height};
}
/// The pixel of a picture of width x height under a point of the window inside `image`.
PixelPosition pixel_under(const Rect& image, Vec2f window, int width, int height);
/// The rectangle of a pixel in the window.
Rect pixel_place(const Rect& image, PixelPosition pixel, int width, int height);

/// A part of a picture and its place in the window.
struct PictureSlice {
    int x = 0;  ///< in pixels of the picture
    int y = 0;
    int width = 0;
    int height = 0;
    Rect place;
};

/// Cuts the visible part of a magnified picture at the pixels that `clip` cuts: at most 3 x 3 parts, which together show exactly what
/// the whole picture in `image` would show inside `clip`, however large `image` is.
std::vector<PictureSlice> visible_slices(const Rect& image, const Rect& clip, int width, int height);

/// Which part of the picture the window shows, and how large. The default is the whole picture.
class PictureZoom {
public:
    static constexpr float kLargest = 128.0f;  ///< window pixels per pixel of the picture

    bool is_whole() const { return scale_ == 0.0f; }
    /// Window pixels per pixel of the picture; 0 for the whole picture at the size that fits. Above 1 a whole number, so that all
    /// pixels have the same size.
    float scale() const { return scale_; }
    void reset() { *this = {}; }

    /// The rectangle of the whole picture of width x height, most of which may be outside of `view`.
    Rect place(const Rect& view, int width, int height) const;
    /// Steps through 1:1 and whole multiples; positive notches enlarge. The point of the picture under `pointer` stays there.
    /// Smaller than the fitting size becomes the whole picture.
    void step(int notches, Vec2f pointer, const Rect& view, int width, int height);
    /// 1:1 around `pointer`, or the whole picture if it is zoomed.
    void toggle(Vec2f pointer, const Rect& view, int width, int height);
    /// Moves the picture by window pixels; nothing while it is whole. Its middle stays in reach.
    void pan(Vec2f pixels, int width, int height);

    friend bool operator==(const PictureZoom&, const PictureZoom&) = default;

private:
    void set_scale(float scale, Vec2f pointer, const Rect& view, int width, int height);

    float scale_ = 0.0f;
    Vec2f center_{0.5f};  ///< point of the picture in the middle of the view
};

// The magnifier: the pixels around the pointer in a box beside it.

struct Magnifier {
    static constexpr int kPixels = 15;  ///< of the picture across the box, odd

    Rect box;             ///< of the magnified pixels, in the window
    Rect source;          ///< of the whole picture as it is under the pointer
    Rect image;           ///< of the whole picture at this size
    PixelPosition pixel;  ///< under the pointer, in the middle of the box
    Rect middle;          ///< its place in the box
};

/// The magnifier at a pointer over a picture of width x height in `image`. The box is beside the pointer and, if there is room,
/// inside `view`. `em` is the font size in pixels.
Magnifier make_magnifier(const Rect& image, Vec2f pointer, int width, int height, const Rect& view, float em);

}  // namespace pl::ui
