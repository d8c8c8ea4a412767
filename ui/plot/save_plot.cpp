#include "ui/plot/save_plot.h"

#include <fmt/format.h>

namespace pl::ui {
namespace {

constexpr Rect kFrame{64.0f, 24.0f, 560.0f, 360.0f};  ///< of the curves, in pixels of the file
constexpr float kLineHeight = 18.0f;

std::string escaped(const std::string& text) {
    std::string result;
    for (const char letter : text)
        if (letter == '&')
            result += "&amp;";
        else if (letter == '<')
            result += "&lt;";
        else
            result += letter;
    return result;
}

std::string text_at(float x, float y, const char* anchor, const std::string& text) {
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor, escaped(text));
}

std::string grid_line(Vec2f from, Vec2f to) {
    return fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" stroke=\"#ddd\"/>\n", from.x, from.y, to.x, to.y);
}

std::string axes(const AccuracyModel& model) {
    const PlotView& view = model.view();
    const float bottom = kFrame.y + kFrame.height;
    const float right = kFrame.x + kFrame.width;
    std::string text;
    for (const AxisTick& tick : view.x_axis().ticks(12)) {
        const float x = view.to_window({tick.value, view.y_axis().low()}, kFrame).x;
        text += grid_line({x, kFrame.y}, {x, bottom}) + text_at(x, bottom + 16.0f, "middle", tick.label);
    }
    for (const AxisTick& tick : view.y_axis().ticks(12)) {
        const float y = view.to_window({view.x_axis().low(), tick.value}, kFrame).y;
        text += grid_line({kFrame.x, y}, {right, y}) + text_at(kFrame.x - 6.0f, y + 4.0f, "end", tick.label);
    }
    const bool is_time = model.kind().axis == CostAxis::Seconds;
    return text + text_at(kFrame.x, kFrame.y - 8.0f, "start", info_of(model.kind().metric).label) +
           text_at(right, bottom + 34.0f, "end", is_time ? "seconds charged" : "samples per pixel");
}

std::string curve(const PlotLine& line, const PlotView& view) {
    std::string points;
    for (const LinePoint& point : line.points) {
        const Vec2f at = view.to_window(point.value, kFrame);
        points += fmt::format("{:.1f},{:.1f} ", at.x, at.y);
    }
    return fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"#{:06x}\" stroke-width=\"2\"{}/>\n", points,
                       line.color & 0xffffffu, line.is_dashed ? " stroke-dasharray=\"8 5\"" : "");
}

bool is_drawn(const PlotLine& line) { return line.comparable && !line.hidden && !line.points.empty(); }

}  // namespace

std::string plot_svg(const AccuracyModel& model) {
    std::string curves;
    std::string legend;
    float y = kFrame.y + kFrame.height + 60.0f;
    for (const PlotLine& line : model.lines()) {
        if (!is_drawn(line)) continue;
        curves += curve(line, model.view());
        legend += fmt::format("<path d=\"M{:.0f} {:.0f}h30\" stroke=\"#{:06x}\" stroke-width=\"2\"{}/>\n", kFrame.x,
                              y, line.color & 0xffffffu, line.is_dashed ? " stroke-dasharray=\"8 5\"" : "") +
                  text_at(kFrame.x + 38.0f, y + 4.0f, "start", line.name);
        y += kLineHeight;
    }
    return fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
                       "font-family=\"sans-serif\" font-size=\"12\">\n"
                       "<rect width=\"{0:.0f}\" height=\"{1:.0f}\" fill=\"white\"/>\n{2}"
                       "<clipPath id=\"frame\"><rect x=\"{3}\" y=\"{4}\" width=\"{5}\" height=\"{6}\"/></clipPath>\n"
                       "<g clip-path=\"url(#frame)\">\n{7}</g>\n{8}</svg>\n",
                       kFrame.x + kFrame.width + 24.0f, y, axes(model), kFrame.x, kFrame.y, kFrame.width,
                       kFrame.height, curves, legend);
}

std::string plot_csv(const AccuracyModel& model) {
    std::string text = "run,spp,seconds,noise,relmse\n";
    for (const auto& run : model.runs()) {
        if (run->label.picture != model.picture()) continue;
        for (const LivePoint& point : run->points) {
            const auto relmse = error_of(point, ErrorMetric::RelMse);
            text +=
                fmt::format("\"{}\",{},{:.9g},{:.9g},{}\n", name_of(run->label), point.spp,
                            charged_seconds(point.clocks), point.noise, relmse ? fmt::format("{:.9g}", *relmse) : "");
        }
    }
    return text;
}

}  // namespace pl::ui
