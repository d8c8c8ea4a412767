#include "app/report/convergence_plots.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

namespace pl {
namespace {

constexpr int kBandPoints = 32;

/// Errors and costs of all runs at one step of the ladder.
struct StepValues {
    std::vector<double> errors;
    std::vector<double> seconds;
};

std::map<std::uint32_t, StepValues> steps_of(const std::vector<BenchRun>& runs, const BenchCell& cell) {
    std::map<std::uint32_t, StepValues> steps;
    for (const BenchRun& run : runs) {
        if (run.warm_up || run.cell != cell) continue;
        for (const RunPoint& point : run.series.points) {
            StepValues& step = steps[point.spp];
            step.errors.push_back(point.metrics.relmse);
            step.seconds.push_back(charged_seconds(point.clocks));
        }
    }
    return steps;
}

std::vector<PlotPoint> line_of(const std::vector<BenchRun>& runs, const CellSummary& cell, bool over_time) {
    std::vector<PlotPoint> line;
    for (const auto& [spp, step] : steps_of(runs, cell.cell)) {
        const double error = geometric_interval(step.errors).value;
        const double seconds = geometric_interval(step.seconds).value;
        if (step.errors.size() != cell.ends.size() || !(error > 0.0)) continue;
        line.push_back(
            {over_time ? seconds : static_cast<double>(spp), error,
             fmt::format("{}: {} samples, {:.3g} s, relMSE {:.3g}", cell.cell.title(), spp, seconds, error)});
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

Plot make_plot(const BenchResults& results, const std::string& scene, bool over_time) {
    Plot plot{.title = scene,
              .x_label = over_time ? "seconds: placing, precomputing, learning, rendering" : "samples per pixel",
              .y_label = "relative squared error (relMSE)",
              .series = {}};
    plot.floor = results.references.value(scene, Json::object()).value("noise_relmse", 0.0);
    for (const CellSummary& cell : results.summary.cells) {
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

std::vector<NamedPlot> convergence_plots(const BenchResults& results) {
    std::vector<NamedPlot> plots;
    for (const std::string& scene : scene_order(results.plan)) {
        plots.push_back({scene, scene + "-time", make_plot(results, scene, true)});
        plots.push_back({scene, scene + "-samples", make_plot(results, scene, false)});
    }
    return plots;
}

}  // namespace pl
