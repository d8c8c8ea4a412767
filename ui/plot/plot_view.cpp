#include "ui/plot/plot_view.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pl::ui {
namespace {

constexpr double kZoomStep = 1.2;        ///< factor of a span in decades per notch
constexpr double kFarthestPower = 15.0;  ///< axes stay between 10^-15 and 10^15

/// Moves the axis by a share of its length.
LogAxis moved(const LogAxis& axis, double share) {
    const double span = std::log10(axis.high() / axis.low());
    const double low = std::clamp(std::log10(axis.low()) + share * span, -kFarthestPower, kFarthestPower - span);
    return LogAxis::exactly(std::pow(10.0, low), std::pow(10.0, low + span));
}

/// Multiplies the length of the axis; the value at `position` keeps its place.
LogAxis scaled(const LogAxis& axis, double factor, double position) {
    const double span = std::log10(axis.high() / axis.low());
    const double wanted = std::clamp(span * factor, PlotView::kLeastDecades, PlotView::kMostDecades);
    const double fixed = std::log10(axis.low()) + position * span;
    const double low = std::clamp(fixed - position * wanted, -kFarthestPower, kFarthestPower - wanted);
    return LogAxis::exactly(std::pow(10.0, low), std::pow(10.0, low + wanted));
}

/// The axis shortened and moved so that it lies in [low, high].
LogAxis within(const LogAxis& axis, double low, double high) {
    const double span = std::min(std::log10(axis.high() / axis.low()), std::log10(high / low));
    const double first = std::clamp(std::log10(axis.low()), std::log10(low), std::log10(high) - span);
    return LogAxis::exactly(std::pow(10.0, first), std::pow(10.0, first + span));
}

/// The largest of 1, 2 and 5 times a power of ten that is not above `value`, or the smallest not below it.
double round_to_tick(double value, bool up) {
    constexpr double kSlack = 1.0 + 1.0e-9;  // rounding of a tick gives the tick itself
    const double power = std::pow(10.0, std::floor(std::log10(value)));
    if (up) {
        for (const double digit : {1.0, 2.0, 5.0, 10.0})
            if (digit * power * kSlack >= value) return digit * power;
        return 10.0 * power;
    }
    for (const double digit : {5.0, 2.0})
        if (digit * power <= value * kSlack) return digit * power;
    return power;
}

struct AxisBounds {
    double low = std::numeric_limits<double>::infinity();
    double high = 0.0;

    void add(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    /// At least one step of ticks wide.
    void round_out() {
        low = round_to_tick(low, false);
        high = round_to_tick(high, true);
        if (high <= low) {
            low = round_to_tick(0.9 * low, false);
            high = round_to_tick(1.1 * high, true);
        }
    }
};

}  // namespace

bool can_be_shown(const PlotValue& value) {
    return value.x > 0.0 && value.y > 0.0 && std::isfinite(value.x) && std::isfinite(value.y);
}

PlotView::PlotView(const PlotRange& range)
    : x_(LogAxis::exactly(range.x_low, range.x_high)), y_(LogAxis::exactly(range.y_low, range.y_high)) {}

Vec2f PlotView::to_window(const PlotValue& value, const Rect& frame) const {
    return {frame.x + static_cast<float>(x_.position(value.x)) * frame.width,
            frame.y + (1.0f - static_cast<float>(y_.position(value.y))) * frame.height};
}

PlotValue PlotView::to_value(Vec2f window, const Rect& frame) const {
    return {x_.value_at((window.x - frame.x) / frame.width), y_.value_at(1.0f - (window.y - frame.y) / frame.height)};
}

void PlotView::pan(Vec2f pixels, const Rect& frame) {
    x_ = moved(x_, -pixels.x / frame.width);
    y_ = moved(y_, pixels.y / frame.height);
}

void PlotView::zoom(float notches, Vec2f at, const Rect& frame) {
    const double factor = std::pow(kZoomStep, -static_cast<double>(notches));
    x_ = scaled(x_, factor, (at.x - frame.x) / frame.width);
    y_ = scaled(y_, factor, 1.0f - (at.y - frame.y) / frame.height);
}

void PlotView::keep_at(const PlotRange& data) {
    static const double kMargin = std::pow(10.0, kMarginDecades);
    x_ = within(x_, data.x_low / kMargin, data.x_high * kMargin);
    y_ = within(y_, data.y_low / kMargin, data.y_high * kMargin);
}

PlotRange fit_range(std::span<const PlotValue> values) {
    AxisBounds x;
    AxisBounds y;
    for (const PlotValue& value : values) {
        if (!can_be_shown(value)) continue;
        x.add(value.x);
        y.add(value.y);
    }
    if (!(x.high > 0.0)) return {.x_low = 0.1, .x_high = 10.0, .y_low = 0.1, .y_high = 10.0};
    x.round_out();
    y.round_out();
    return {x.low, x.high, y.low, y.high};
}

}  // namespace pl::ui
