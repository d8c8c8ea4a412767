#include "core/plot/svg_plot.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "core/base/printable.h"

namespace pl {
namespace {

struct Range {
    double low = std::numeric_limits<double>::infinity();
    double high = 0.0;

    void add(double value) {
        if (!(value > 0.0)) return;
        low = std::min(low, value);
        high = std::max(high, value);
    }
};

class SvgPlot {
public:
    explicit SvgPlot(const Plot& plot) : plot_(plot), x_axis_(plot.x_axis()), y_axis_(plot.y_axis()) {
        for (const PlotSeries& series : plot.series) {
            const int legend = kLegendText + kCharacterWidth * static_cast<int>(series.name.size());
            layout_.width += std::max(legend - layout_.right, 0);
            layout_.right = std::max(legend, layout_.right);
        }
    }

    std::string draw() {
        text_ = fmt::format(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
            "font-family=\"sans-serif\" font-size=\"13\" role=\"img\">\n<title>{2}</title>\n"
            "<rect width=\"{0}\" height=\"{1}\" fill=\"#fff\"/>\n",
            layout_.width, layout_.height, markup_text(plot_.title));
        draw_floor();
        draw_axes();
        // An inner image clips what it holds.
        text_ += fmt::format("<svg x=\"{0}\" y=\"{1}\" width=\"{2}\" height=\"{3}\" viewBox=\"{0} {1} {2} {3}\">\n",
                             layout_.left, layout_.top, frame_right() - layout_.left, frame_bottom() - layout_.top);
        for (const PlotSeries& series : plot_.series) draw_band(series);
        for (const PlotSeries& series : plot_.series) draw_line(series);
        text_ += "</svg>\n";
        draw_legend();
        return text_ + "</svg>\n";
    }

private:
    static constexpr int kLegendText = 44;     ///< from the frame to the names, pixels
    static constexpr int kCharacterWidth = 8;  ///< of a name in the legend at most, pixels

    double x(double value) const { return layout_.x(x_axis_, value); }
    double y(double value) const { return layout_.y(y_axis_, value); }
    int frame_right() const { return layout_.width - layout_.right; }
    int frame_bottom() const { return layout_.height - layout_.bottom; }

    static std::string color(std::uint32_t argb) { return fmt::format("#{:06x}", argb & 0xffffffu); }
    static std::string dashes(int style) {
        return style == 0 ? "" : style == 1 ? " stroke-dasharray=\"8 4\"" : " stroke-dasharray=\"2 4\"";
    }

    void segment(double x0, double y0, double x1, double y1, const char* stroke) {
        text_ += fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\"/>\n", x0,
                             y0, x1, y1, stroke);
    }
    void words(double at_x, double at_y, const char* anchor, const std::string& text, const char* more = "") {
        if (text.empty()) return;
        text_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>\n", at_x, at_y, anchor,
                             more, markup_text(text));
    }

    void draw_floor() {
        if (!(plot_.floor > y_axis_.low())) return;
        const double top = y(std::min(plot_.floor, y_axis_.high()));
        text_ +=
            fmt::format("<rect x=\"{}\" y=\"{:.1f}\" width=\"{}\" height=\"{:.1f}\" fill=\"#ddd\"><title>below the "
                        "noise of the reference</title></rect>\n",
                        layout_.left, top, frame_right() - layout_.left, frame_bottom() - top);
    }

    void draw_axes() {
        for (const AxisTick& tick : x_axis_.ticks(10)) {
            segment(x(tick.value), layout_.top, x(tick.value), frame_bottom(), tick.label.empty() ? "#eee" : "#ccc");
            words(x(tick.value), frame_bottom() + 18, "middle", tick.label);
        }
        for (const AxisTick& tick : y_axis_.ticks(10)) {
            segment(layout_.left, y(tick.value), frame_right(), y(tick.value), tick.label.empty() ? "#eee" : "#ccc");
            words(layout_.left - 8, y(tick.value) + 4, "end", tick.label);
        }
        text_ += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#666\"/>\n",
                             layout_.left, layout_.top, frame_right() - layout_.left, frame_bottom() - layout_.top);
        const double middle_y = 0.5 * (layout_.top + frame_bottom());
        words(0.5 * (layout_.left + frame_right()), layout_.height - 12, "middle", plot_.x_label);
        words(18, middle_y, "middle", plot_.y_label,
              fmt::format(" transform=\"rotate(-90 18 {:.1f})\"", middle_y).c_str());
        words(layout_.left, layout_.top - 14, "start", plot_.title, " font-weight=\"bold\" font-size=\"15\"");
    }

    void draw_band(const PlotSeries& series) {
        if (series.band.size() < 2) return;
        std::string path;
        for (const BandPoint& point : series.band) path += fmt::format(" {:.1f},{:.1f}", x(point.x), y(point.high));
        for (auto point = series.band.rbegin(); point != series.band.rend(); ++point)
            path += fmt::format(" {:.1f},{:.1f}", x(point->x), y(point->low));
        text_ += fmt::format("<polygon points=\"{}\" fill=\"{}\" fill-opacity=\"0.18\"/>\n", path.substr(1),
                             color(series.color));
    }

    void draw_line(const PlotSeries& series) {
        std::string path;
        for (const PlotPoint& point : series.line) path += fmt::format(" {:.1f},{:.1f}", x(point.x), y(point.y));
        if (path.empty()) return;
        text_ += fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"{}/>\n",
                             path.substr(1), color(series.color), dashes(series.style));
        for (const PlotPoint& point : series.line)
            text_ +=
                fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" fill=\"{}\"><title>{}</title></circle>\n",
                            x(point.x), y(point.y), color(series.color), markup_text(point.note));
    }

    void draw_legend() {
        double at = layout_.top + 10;
        const double left = frame_right() + 12;
        for (const PlotSeries& series : plot_.series) {
            text_ += fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\" "
                                 "stroke-width=\"2\"{}/>\n",
                                 left, at, left + 26, at, color(series.color), dashes(series.style));
            words(left + 32, at + 4, "start", series.name);
            at += 22;
        }
        if (plot_.floor > y_axis_.low()) words(left, at + 4, "start", "gray: reference noise");
    }

    const Plot& plot_;
    PlotLayout layout_;
    LogAxis x_axis_;
    LogAxis y_axis_;
    std::string text_;
};

}  // namespace

LogAxis Plot::x_axis() const {
    if (x_shown) return *x_shown;
    Range range;
    for (const PlotSeries& one : series) {
        for (const PlotPoint& point : one.line) range.add(point.x);
        for (const BandPoint& point : one.band) range.add(point.x);
    }
    return {range.low, range.high};
}

LogAxis Plot::y_axis() const {
    if (y_shown) return *y_shown;
    Range range;
    for (const PlotSeries& one : series) {
        for (const PlotPoint& point : one.line) range.add(point.y);
        for (const BandPoint& point : one.band) {
            range.add(point.low);
            range.add(point.high);
        }
    }
    return {range.low, range.high};
}

std::string svg_plot(const Plot& plot) { return SvgPlot(plot).draw(); }

}  // namespace pl
