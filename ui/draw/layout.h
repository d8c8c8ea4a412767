// The rectangles of panels and picture in the window, recomputed each frame from its size and the font.
#pragma once

#include "ui/draw/draw_list.h"

namespace pl {

struct Layout {
    Rect menu;
    Rect left;      ///< settings
    Rect right;     ///< tabs: volume, material, effects, pixel, statistics, log
    Rect accuracy;  ///< error against time, below that; empty if it is closed
    Rect status;
    Rect view;   ///< available to the picture
    Rect clear;  ///< the part of it that no panel covers
    bool panels = true;
};

/// All in pixels; `em` is the font size. In a window too narrow for panels and picture the panels float over it.
/// `detail`: the tabs have more to show, and get more than half of the height beside the accuracy panel.
Layout make_layout(float width, float height, float em, bool panels, bool accuracy, bool detail);

/// The largest rectangle with the shape of a picture of width x height in the middle of `view`. A picture that is
/// somewhat smaller than the view is shown pixel by pixel.
Rect place_image(const Rect& view, int width, int height);

/// Size of a picture with the shape of width x height that fills the view pixel by pixel; at least 64 pixels wide.
struct ImageSize {
    int width;
    int height;
};
ImageSize fit_image(const Rect& view, int width, int height);

}  // namespace pl
