// Runs as curves: which number is the error and which the cost, and what tells one run from another on screen.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "core/measure/live_runs.h"

namespace pl {

/// What a plot shows upwards. All but Noise need a reference.
enum class ErrorMetric { RelMse, RelMseTrimmed, Mse, Smape, Noise };
inline constexpr int kErrorMetricCount = 5;

struct ErrorMetricInfo {
    ErrorMetric id;
    const char* label;  ///< on the axis
    const char* what;   ///< one sentence
    double slope;       ///< over cost in log-log, where only noise is left
};
const ErrorMetricInfo& info_of(ErrorMetric metric);

/// What it shows to the right.
enum class CostAxis { Seconds, Samples };

/// What a curve of a run is made of.
struct CurveKind {
    ErrorMetric metric = ErrorMetric::RelMse;
    CostAxis axis = CostAxis::Seconds;

    friend bool operator==(const CurveKind&, const CurveKind&) = default;
};

/// Empty where it was not measured.
std::optional<double> error_of(const LivePoint& point, ErrorMetric metric);
/// Standard error of error_of() over the blocks of this one picture; 0 where it is not known.
double error_off(const LivePoint& point, ErrorMetric metric);
double cost_of(const LivePoint& point, CostAxis axis);

/// The points at which the error was measured, by ascending cost.
Curve curve_of(const LiveRun& run, const CurveKind& kind);
/// The same with samples per pixel in place of errors, or seconds where the cost is samples: how one follows from the
/// other along a run.
Curve other_cost_of(const LiveRun& run, CostAxis axis);

/// "Reinforcement CPU, warm": all that differs from other runs.
std::string name_of(const RunLabel& label);

/// Opaque ARGB, one for each method, told apart also by most people who see few colors, on dark ground.
/// [Okabe and Ito 2008]
std::uint32_t color_of(MethodId method);

enum class LineStyle { Full, Dashed, Dotted };
/// One for each back end.
LineStyle style_of(const std::string& backend);

using RunList = std::span<const std::shared_ptr<const LiveRun>>;

/// Null if there is none with this number.
std::shared_ptr<const LiveRun> find_run(RunList runs, std::uint64_t number);

/// The run of default path tracing that `run` is measured against: of the same picture; on the same back end and with the
/// same light sampling where there is one; else the newest. Null if there is none, or if `run` is the one.
std::shared_ptr<const LiveRun> base_of(RunList runs, const LiveRun& run);

}  // namespace pl
