#include "ui/plot/run_lines.h"

#include <algorithm>
#include <array>
#include <cctype>

#include <fmt/format.h>

namespace pl::ui {
namespace {

constexpr std::array<ErrorMetricInfo, kErrorMetricCount> kMetrics{{
    {ErrorMetric::RelMse, "relMSE", "Squared error over the squared reference, mean of all pixels.", -1.0},
    {ErrorMetric::RelMseTrimmed, "relMSE without the worst 0.1 %",
     "relMSE without the 0.1 % of the pixels with the largest errors.", -1.0},
    {ErrorMetric::Mse, "MSE", "Squared error in linear radiance: dominated by bright pixels.", -1.0},
    {ErrorMetric::Smape, "SMAPE", "Absolute error over the mean of picture and reference.", -0.5},
    {ErrorMetric::Noise, "own noise as relMSE",
     "Estimated from the difference of two halves of the picture: needs no reference.", -1.0},
}};

std::optional<double> metric_of(const Metrics& metrics, ErrorMetric metric) {
    switch (metric) {
    case ErrorMetric::RelMse: return metrics.relmse;
    case ErrorMetric::RelMseTrimmed: return metrics.relmse_trimmed;
    case ErrorMetric::Mse: return metrics.mse;
    case ErrorMetric::Smape: return metrics.smape;
    case ErrorMetric::Noise: break;
    }
    return std::nullopt;
}

}  // namespace

const ErrorMetricInfo& info_of(ErrorMetric metric) { return kMetrics[static_cast<std::size_t>(metric)]; }

std::optional<double> error_of(const LivePoint& point, ErrorMetric metric) {
    if (metric == ErrorMetric::Noise) return point.noise;
    return point.metrics ? metric_of(*point.metrics, metric) : std::nullopt;
}

double error_off(const LivePoint& point, ErrorMetric metric) {
    if (metric == ErrorMetric::Noise) return point.noise_off;
    return metric == ErrorMetric::RelMse ? point.relmse_off.value_or(0.0) : 0.0;
}

double cost_of(const LivePoint& point, CostAxis axis) {
    return axis == CostAxis::Seconds ? charged_seconds(point.clocks) : static_cast<double>(point.spp);
}

Curve curve_of(const LiveRun& run, const CurveKind& kind) {
    Curve curve;
    for (const LivePoint& point : run.points)
        if (const auto error = error_of(point, kind.metric)) curve.push_back({cost_of(point, kind.axis), *error});
    return curve;
}

Curve other_cost_of(const LiveRun& run, CostAxis axis) {
    const CostAxis other = axis == CostAxis::Seconds ? CostAxis::Samples : CostAxis::Seconds;
    Curve curve;
    for (const LivePoint& point : run.points) curve.push_back({cost_of(point, axis), cost_of(point, other)});
    return curve;
}

std::string name_of(const RunLabel& label) {
    std::string backend = label.backend;
    for (char& letter : backend) letter = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
    std::string name = fmt::format("{} {}", info_of(label.method).label, backend);
    if (label.next_event) name += ", light samples";
    if (label.seed > 1) name += fmt::format(", seed {}", label.seed);
    if (!label.details.empty()) name += ", " + label.details;
    if (label.warm) name += ", warm";
    return name;
}

LineStyle style_of(const RunLabel& label) { return label.next_event ? LineStyle::Full : LineStyle::Dashed; }

PlotMarker marker_of(const RunLabel& label) { return {.square = label.backend != "cpu", .hollow = label.warm}; }

std::shared_ptr<const LiveRun> find_run(RunList runs, std::uint64_t number) {
    const auto found = std::ranges::find(runs, number, [](const auto& run) { return run->number; });
    return found != runs.end() ? *found : nullptr;
}

std::shared_ptr<const LiveRun> base_of(RunList runs, const LiveRun& run) {
    std::shared_ptr<const LiveRun> best;
    int best_likeness = -1;
    for (const auto& other : runs) {
        const RunLabel& label = other->label;
        if (label.method != baseline_method() || label.picture != run.label.picture) continue;
        const int likeness = (label.next_event == run.label.next_event ? 4 : 0) +
                             (label.backend == run.label.backend ? 2 : 0) +
                             (label.details == run.label.details ? 1 : 0);
        if (likeness < best_likeness || other->points.empty()) continue;
        best = other;
        best_likeness = likeness;
    }
    return best && best->number != run.number ? best : nullptr;
}

}  // namespace pl::ui
