// The target of a drag on the plot: the view or a cursor. Decided at the press and kept until the release.
#pragma once

#include <cmath>
#include <optional>

#include "ui/draw/draw_list.h"

namespace pl::ui {

enum class PlotDrag { None, Pan, EqualCost, EqualError };

/// Largest distance in pixels from which a cursor's line can be dragged.
inline constexpr float kCursorReach = 6.0f;

/// `frame` is the rectangle of the curves, with the numbers of the axes below it and to its left; `cost_x` and `error_y`
/// are the positions of the cursors' lines in the window.
inline PlotDrag drag_at(Vec2f pointer, const Rect& frame, std::optional<float> cost_x, std::optional<float> error_y) {
    const bool right_of_left = pointer.x >= frame.x && pointer.x < frame.x + frame.width;
    const bool above_bottom = pointer.y >= frame.y && pointer.y < frame.y + frame.height;
    if (frame.contains(pointer)) {
        if (cost_x && std::fabs(pointer.x - *cost_x) <= kCursorReach) return PlotDrag::EqualCost;
        if (error_y && std::fabs(pointer.y - *error_y) <= kCursorReach) return PlotDrag::EqualError;
        return PlotDrag::Pan;
    }
    if (right_of_left && pointer.y >= frame.y + frame.height) return PlotDrag::EqualCost;
    if (above_bottom && pointer.x < frame.x) return PlotDrag::EqualError;
    return PlotDrag::None;
}

}  // namespace pl::ui
