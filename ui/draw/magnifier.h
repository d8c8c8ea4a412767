// The magnifier: the pixels around the pointer in a box beside it.
#pragma once

#include "ui/draw/picture_zoom.h"

namespace pl::ui {

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
