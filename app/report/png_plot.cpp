#include <algorithm>
#include <cmath>

#include "app/report/plot.h"

namespace pl {
namespace {

constexpr Rgb kInk{40, 40, 40};
constexpr Rgb kMajor{204, 204, 204};
constexpr Rgb kMinor{238, 238, 238};
constexpr Rgb kFloor{221, 221, 221};

Rgb faded(const Rgb& color) {
    Rgb result{};
    for (std::size_t c = 0; c < 3; ++c) result[c] = static_cast<std::uint8_t>(204 + color[c] / 5);
    return result;
}

class PngPlot {
public:
    explicit PngPlot(const Plot& plot)
        : plot_(plot), x_axis_(plot.x_axis()), y_axis_(plot.y_axis()),
          layout_{.width = 1100, .height = 640, .left = 110, .right = 330, .top = 50, .bottom = 70},
          canvas_(layout_.width, layout_.height, {255, 255, 255}) {}

    ByteImage draw() {
        if (plot_.floor > y_axis_.low()) {
            const int top = y(std::min(plot_.floor, y_axis_.high()));
            canvas_.fill(layout_.left, top, right() - layout_.left, bottom() - top, kFloor);
        }
        for (const PlotSeries& series : plot_.series) draw_band(series);
        draw_axes();
        for (const PlotSeries& series : plot_.series) draw_line(series);
        draw_legend();
        return canvas_.image();
    }

private:
    int x(double value) const { return static_cast<int>(std::lround(layout_.x(x_axis_, value))); }
    int y(double value) const { return static_cast<int>(std::lround(layout_.y(y_axis_, value))); }
    int right() const { return layout_.width - layout_.right; }
    int bottom() const { return layout_.height - layout_.bottom; }

    void draw_axes() {
        for (const bool labeled : {false, true}) {  // the darker lines over the lighter ones
            const Rgb line = labeled ? kMajor : kMinor;
            for (const AxisTick& tick : x_axis_.ticks(8)) {
                if (tick.label.empty() == labeled) continue;
                canvas_.fill(x(tick.value), layout_.top, 1, bottom() - layout_.top, line);
                canvas_.text(x(tick.value) - Canvas::text_width(tick.label) / 2, bottom() + 8, tick.label, kInk);
            }
            for (const AxisTick& tick : y_axis_.ticks(10)) {
                if (tick.label.empty() == labeled) continue;
                canvas_.fill(layout_.left, y(tick.value), right() - layout_.left, 1, line);
                canvas_.text(layout_.left - 8 - Canvas::text_width(tick.label), y(tick.value) - 7, tick.label, kInk);
            }
        }
        canvas_.text(layout_.left, 12, plot_.title + ": " + plot_.y_label, kInk);
        canvas_.text((layout_.left + right() - Canvas::text_width(plot_.x_label)) / 2, layout_.height - 28,
                     plot_.x_label, kInk);
    }

    /// Fills the columns between the lines through the bounds.
    void draw_band(const PlotSeries& series) {
        for (std::size_t i = 1; i < series.band.size(); ++i) {
            const BandPoint& a = series.band[i - 1];
            const BandPoint& b = series.band[i];
            const int first = x(a.x);
            const int last = std::max(x(b.x), first + 1);
            for (int column = first; column < last; ++column) {
                const double share = static_cast<double>(column - first) / (last - first);
                const auto between = [share](int from, int to) {
                    return static_cast<int>(std::lround(from + share * (to - from)));
                };
                const int top = between(y(a.high), y(b.high));
                canvas_.fill(column, top, 1, between(y(a.low), y(b.low)) - top, faded(series.color));
            }
        }
    }

    void draw_line(const PlotSeries& series) {
        double drawn = 0.0;
        for (std::size_t i = 1; i < series.line.size(); ++i) {
            const PlotPoint& a = series.line[i - 1];
            const PlotPoint& b = series.line[i];
            drawn = stroke(x(a.x), y(a.y), x(b.x), y(b.y), series, drawn);
        }
        for (const PlotPoint& point : series.line) canvas_.fill(x(point.x) - 3, y(point.y) - 3, 7, 7, series.color);
    }

    /// Returns the length of the line so far, so that dashes continue around corners.
    double stroke(int x0, int y0, int x1, int y1, const PlotSeries& series, double drawn) {
        const int steps = std::max({std::abs(x1 - x0), std::abs(y1 - y0), 1});
        const double step_length = std::hypot(x1 - x0, y1 - y0) / steps;
        for (int i = 0; i <= steps; ++i) {
            const double length = drawn + i * step_length;
            const bool ink = series.style == 0 ||
                             std::fmod(length, series.style == 1 ? 15.0 : 8.0) < (series.style == 1 ? 10.0 : 3.0);
            if (ink) canvas_.fill(x0 + (x1 - x0) * i / steps - 1, y0 + (y1 - y0) * i / steps - 1, 3, 3, series.color);
        }
        return drawn + steps * step_length;
    }

    void draw_legend() {
        int at = layout_.top + 10;
        const int left = right() + 14;
        for (const PlotSeries& series : plot_.series) {
            stroke(left, at + 7, left + 40, at + 7, series, 0.0);
            canvas_.text(left + 50, at, series.name, kInk);
            at += 28;
        }
        if (plot_.floor > y_axis_.low()) canvas_.text(left, at, "gray: reference noise", kInk);
    }

    const Plot& plot_;
    LogAxis x_axis_;
    LogAxis y_axis_;
    PlotLayout layout_;
    Canvas canvas_;
};

}  // namespace

ByteImage png_plot(const Plot& plot) { return PngPlot(plot).draw(); }

}  // namespace pl
