#include "app/report/bench_plots.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include <fmt/format.h>

namespace pl {

std::uint32_t method_color(const std::string& method) {
    if (method == "default") return 0xff0072b2u;
    if (method == "precomputed") return 0xffe69f00u;
    if (method == "reinforcement") return 0xff009e73u;
    return 0xffcc79a7u;
}

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
