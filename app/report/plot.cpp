#include "app/report/plot.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>

#include <fmt/format.h>

namespace pl {

std::string escape_markup(std::string_view text) {
    std::string result;
    for (const char c : text) switch (c) {
        case '&': result += "&amp;"; break;
        case '<': result += "&lt;"; break;
        case '>': result += "&gt;"; break;
        case '"': result += "&quot;"; break;
        case '\'': result += "&#39;"; break;
        default: result += c;
        }
    return result;
}

std::string base64(std::string_view bytes) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = group << 8 | (i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : kDigits[group >> (18 - 6 * k) & 63u];
    }
    return text;
}

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
    explicit SvgPlot(const Plot& plot) : plot_(plot), x_axis_(plot.x_axis()), y_axis_(plot.y_axis()) {}

    std::string draw() {
        text_ = fmt::format(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
            "font-family=\"sans-serif\" font-size=\"13\" role=\"img\">\n<title>{2}</title>\n"
            "<rect width=\"{0}\" height=\"{1}\" fill=\"#fff\"/>\n",
            layout_.width, layout_.height, escape_markup(plot_.title));
        draw_floor();
        draw_axes();
        for (const PlotSeries& series : plot_.series) draw_band(series);
        for (const PlotSeries& series : plot_.series) draw_line(series);
        draw_legend();
        return text_ + "</svg>\n";
    }

private:
    double x(double value) const { return layout_.x(x_axis_, value); }
    double y(double value) const { return layout_.y(y_axis_, value); }
    int frame_right() const { return layout_.width - layout_.right; }
    int frame_bottom() const { return layout_.height - layout_.bottom; }

    static std::string color(const Rgb& rgb) { return fmt::format("#{:02x}{:02x}{:02x}", rgb[0], rgb[1], rgb[2]); }
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
                             more, escape_markup(text));
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
                            x(point.x), y(point.y), color(series.color), escape_markup(point.note));
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
    Range range;
    for (const PlotSeries& one : series) {
        for (const PlotPoint& point : one.line) range.add(point.x);
        for (const BandPoint& point : one.band) range.add(point.x);
    }
    return {range.low, range.high};
}

LogAxis Plot::y_axis() const {
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

Rgb method_color(const std::string& method) {
    if (method == "default") return {0, 114, 178};
    if (method == "precomputed") return {230, 159, 0};
    if (method == "reinforcement") return {0, 158, 115};
    return {204, 121, 167};
}

std::string svg_plot(const Plot& plot) { return SvgPlot(plot).draw(); }

namespace {

constexpr int kBandPoints = 32;

/// Samples per pixel at which any run of a cell was measured. Runs differ: points are left out where measuring would
/// take too long.
std::set<std::uint32_t> steps_of(const std::vector<const bench::BenchRun*>& runs) {
    std::set<std::uint32_t> steps;
    for (const bench::BenchRun* run : runs)
        for (const RunPoint& point : run->series.points) steps.insert(point.spp);
    return steps;
}

/// Charged seconds over samples per pixel.
Curve seconds_over_samples(const RunSeries& series) {
    Curve curve;
    for (const RunPoint& point : series.points)
        curve.push_back({static_cast<double>(point.spp), charged_seconds(point.clocks)});
    return curve;
}

/// Geometric mean over curves; empty unless the range of each holds `cost`.
std::optional<double> mean_at(const std::vector<Curve>& curves, double cost) {
    const auto interval = error_interval_at(curves, cost);
    return interval && interval->value > 0.0 ? std::optional(interval->value) : std::nullopt;
}

std::vector<PlotPoint> line_of(const std::vector<bench::BenchRun>& all, const bench::CellSummary& cell,
                               bool over_time) {
    std::vector<const bench::BenchRun*> runs;
    std::vector<Curve> seconds;
    for (const bench::BenchRun& run : all)
        if (!run.warm_up && run.cell == cell.cell) {
            runs.push_back(&run);
            seconds.push_back(seconds_over_samples(run.series));
        }
    std::vector<PlotPoint> line;
    for (const std::uint32_t spp : steps_of(runs)) {
        const auto error = mean_at(cell.over_samples, spp);
        const auto time = mean_at(seconds, spp);
        if (!error || !time) continue;
        line.push_back(
            {over_time ? *time : static_cast<double>(spp), *error,
             fmt::format("{}: {} samples, {:.3g} s, relMSE {:.3g}", cell.cell.title(), spp, *time, *error)});
    }
    return line;
}

std::vector<BandPoint> band_of(const std::vector<Curve>& curves) {
    std::vector<BandPoint> band;
    const auto range = common_range(curves);
    if (!range || curves.size() < kFewestRuns) return band;
    for (const double cost : log_spaced(range->first, range->last, kBandPoints)) {
        const auto interval = error_interval_at(curves, cost);
        if (interval && std::isfinite(interval->low) && std::isfinite(interval->high))
            band.push_back({cost, interval->low, interval->high});
    }
    return band;
}

int style_of(const Json& plan, const std::string& backend) {
    int style = 0;
    for (const auto& [name, device] : plan.at("backends").items()) {
        if (name == backend) return style;
        style = std::min(style + 1, 2);
    }
    return style;
}

Plot make_plot(const bench::BenchResults& results, const std::string& scene, bool over_time) {
    Plot plot{.title = scene,
              .x_label = over_time ? "seconds: placing, precomputing, learning, rendering" : "samples per pixel",
              .y_label = "relative squared error (relMSE)",
              .series = {}};
    plot.floor = results.references.value(scene, Json::object()).value("noise_relmse", 0.0);
    for (const bench::CellSummary& cell : results.summary.cells) {
        if (cell.cell.scene != scene) continue;
        plot.series.push_back({.name = fmt::format("{}, {}", cell.cell.method, cell.cell.backend),
                               .color = method_color(cell.cell.method),
                               .style = style_of(results.plan, cell.cell.backend),
                               .line = line_of(results.runs, cell, over_time),
                               .band = band_of(over_time ? cell.over_time : cell.over_samples)});
    }
    return plot;
}

}  // namespace

std::vector<std::string> scene_order(const Json& plan) {
    std::vector<std::string> names;
    for (const Json& scene : plan.at("scenes")) names.push_back(scene.at("name"));
    return names;
}

std::vector<NamedPlot> convergence_plots(const bench::BenchResults& results) {
    std::vector<NamedPlot> plots;
    for (const std::string& scene : scene_order(results.plan)) {
        plots.push_back({scene, scene + "-time", make_plot(results, scene, true)});
        plots.push_back({scene, scene + "-samples", make_plot(results, scene, false)});
    }
    return plots;
}

}  // namespace pl
