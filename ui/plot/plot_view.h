// The ranges of two logarithmic axes that a plot shows, and the mapping of its values to the window.
#pragma once

#include <cmath>
#include <optional>
#include <span>

#include "core/plot/log_axis.h"
#include "ui/draw/draw_list.h"

namespace pl::ui {

/// The target of a drag on the plot: the view or a cursor. Decided at the press and kept until the release.
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

/// Bounds of both axes, positive.
struct PlotRange {
    double x_low = 1.0;
    double x_high = 10.0;
    double y_low = 1.0;
    double y_high = 10.0;
};

/// A point on the plot, in the units of its axes.
struct PlotValue {
    double x = 0.0;
    double y = 0.0;
};

/// Whether logarithmic axes have a place for a value: both coordinates positive and finite.
bool can_be_shown(const PlotValue& value);

class PlotView {
public:
    /// Limits of zooming, in powers of ten.
    static constexpr double kLeastDecades = 0.2;
    static constexpr double kMostDecades = 16.0;

    explicit PlotView(const PlotRange& range = {});

    const LogAxis& x_axis() const { return x_; }
    const LogAxis& y_axis() const { return y_; }

    /// Position of a value in a plot that fills `frame`; may be outside of it. Values must be positive.
    Vec2f to_window(const PlotValue& value, const Rect& frame) const;
    PlotValue to_value(Vec2f window, const Rect& frame) const;

    /// The values under the pointer follow it.
    void pan(Vec2f pixels, const Rect& frame);
    /// Keeps the view at the data: no axis reaches further beyond `data` than kMarginDecades at either end.
    static constexpr double kMarginDecades = 1.0;
    void keep_at(const PlotRange& data);
    /// Zooms in for positive notches; the value at `at` keeps its place.
    void zoom(float notches, Vec2f at, const Rect& frame);

private:
    LogAxis x_;
    LogAxis y_;
};

/// Bounds of all positive finite values, rounded outwards to 1, 2 and 5 times powers of ten, so that axes keep still
/// while curves grow. Two decades around 1 without values.
PlotRange fit_range(std::span<const PlotValue> values);

}  // namespace pl::ui
