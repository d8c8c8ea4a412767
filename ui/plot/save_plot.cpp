#include "ui/plot/save_plot.h"

#include <fmt/format.h>

#include "core/base/printable.h"
#include "core/plot/svg_plot.h"

namespace pl::ui {

std::string plot_svg(const AccuracyModel& model) {
    Plot plot{.title = "",
              .x_label = model.kind().axis == CostAxis::Seconds ? "seconds charged" : "samples per pixel",
              .y_label = info_of(model.kind().metric).label,
              .series = {},
              .floor = model.floor(),
              .x_shown = model.view().x_axis(),
              .y_shown = model.view().y_axis()};
    for (const PlotLine& line : model.lines()) {
        if (line.hidden || line.points.empty()) continue;
        PlotSeries series{
            .name = line.name, .color = line.color, .style = line.is_dashed ? 1 : 0, .line = {}, .band = {}};
        for (const LinePoint& point : line.points) {
            series.line.push_back(
                {point.value.x, point.value.y, fmt::format("{:.4g}, {:.4g}", point.value.x, point.value.y)});
            if (point.low > 0.0) series.band.push_back({point.value.x, point.low, point.high});
        }
        plot.series.push_back(std::move(series));
    }
    return svg_plot(plot);
}

std::string plot_csv(const AccuracyModel& model) {
    std::string text = "run,spp,seconds,noise,relmse\n";
    for (const auto& run : model.runs()) {
        if (run->label.picture != model.picture()) continue;
        for (const LivePoint& point : run->points) {
            const auto relmse = error_of(point, ErrorMetric::RelMse);
            text +=
                fmt::format("{},{},{:.9g},{:.9g},{}\n", csv_text(name_of(run->label)), point.spp,
                            charged_seconds(point.clocks), point.noise, relmse ? fmt::format("{:.9g}", *relmse) : "");
        }
    }
    return text;
}

}  // namespace pl::ui
