// Runs as curves: error and cost of a point, and the name, color and line style of a run.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "core/measure/live_runs.h"

namespace pl::ui {

/// The error on the vertical axis. All but Noise need a reference.
enum class ErrorMetric { RelMse, RelMseTrimmed, Mse, Smape, Noise };
inline constexpr int kErrorMetricCount = 5;

struct ErrorMetricInfo {
    ErrorMetric id;
    const char* label;    ///< on the axis
    const char* meaning;  ///< one sentence
    double slope;         ///< of pure noise over cost, in log-log
};
const ErrorMetricInfo& info_of(ErrorMetric metric);

/// The cost on the horizontal axis.
enum class CostAxis { Seconds, Samples };

/// The axes of a curve.
struct CurveKind {
    ErrorMetric metric = ErrorMetric::RelMse;
    CostAxis axis = CostAxis::Seconds;

    friend bool operator==(const CurveKind&, const CurveKind&) = default;
};

/// Empty if it was not measured.
std::optional<double> error_of(const LivePoint& point, ErrorMetric metric);
/// Standard error of error_of() over the blocks of this one picture; 0 if unknown.
double error_off(const LivePoint& point, ErrorMetric metric);
double cost_of(const LivePoint& point, CostAxis axis);

/// The points at which the error was measured, by ascending cost.
Curve curve_of(const LiveRun& run, const CurveKind& kind);
/// The other cost along a run: samples per pixel over seconds, or seconds over samples per pixel.
Curve other_cost_of(const LiveRun& run, CostAxis axis);

/// "Reinforcement CPU, light samples, warm": everything that distinguishes the run from others.
std::string name_of(const RunLabel& label);

/// Full with light samples, dashed without.
enum class LineStyle { Full, Dashed };
LineStyle style_of(const RunLabel& label);

/// The mark at each point of a run.
struct PlotMarker {
    bool square = false;  ///< of runs on another back end than the CPU; else round
    bool hollow = false;  ///< of warm runs

    friend bool operator==(const PlotMarker&, const PlotMarker&) = default;
};
PlotMarker marker_of(const RunLabel& label);

using RunList = std::span<const std::shared_ptr<const LiveRun>>;

/// Null if no run has this number.
std::shared_ptr<const LiveRun> find_run(RunList runs, std::uint64_t number);

/// The run of the baseline method that `run` is compared with: of the same picture, and preferably with the same light
/// sampling and on the same back end; else the newest. Null without one, and for that run itself.
std::shared_ptr<const LiveRun> base_of(RunList runs, const LiveRun& run);

}  // namespace pl::ui
