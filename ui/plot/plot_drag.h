// What a press on the plot takes hold of. Decided at the press and kept to the release.
#pragma once

#include <cmath>
#include <optional>

#include "ui/overlays/draw_list.h"

namespace pl {

enum class PlotDrag { None, Pan, EqualCost, EqualError };

/// A cursor's line may be taken hold of from so many pixels off.
inline constexpr float kCursorReach = 6.0f;

/// `frame` is where curves are, with the numbers of the axes below and at the left of it; `cost_x` and `error_y` are where
/// the lines of cursors are in the window.
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

}  // namespace pl
