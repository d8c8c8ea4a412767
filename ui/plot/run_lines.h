// Runs as curves: error and cost of a point, and the name, color and line style of a run.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

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

using RunList = std::span<const std::shared_ptr<const LiveRun>>;

/// Empty if it was not measured.
std::optional<double> error_of(const LivePoint& point, ErrorMetric metric);
/// Standard error of error_of() over the blocks of this one picture; 0 if unknown.
double error_off(const LivePoint& point, ErrorMetric metric);
double cost_of(const LivePoint& point, CostAxis axis);

/// The points at which the error was measured, by ascending cost.
Curve curve_of(const LiveRun& run, const CurveKind& kind);
/// The other cost along a run: samples per pixel over seconds, or seconds over samples per pixel.
Curve other_cost_of(const LiveRun& run, CostAxis axis);

/// "Reinforcement (SD-tree) CPU, light samples, warm": everything that distinguishes the run from others.
std::string name_of(const RunLabel& label);

/// Opaque ARGB: of the method, and of its own for each set of other settings among `runs`.
std::uint32_t run_color(RunList runs, const RunLabel& label);

/// Lines of runs without light samples are dashed.
bool is_dashed(const RunLabel& label);

/// The mark at each point of a run.
struct PlotMarker {
    bool square = false;  ///< of runs on another back end than the CPU; else round
    bool hollow = false;  ///< of warm runs

    friend bool operator==(const PlotMarker&, const PlotMarker&) = default;
};
PlotMarker marker_of(const RunLabel& label);

/// Whether two runs differ at most in their seeds, in what was learned before, and in how far they have come.
bool are_of_one_kind(const RunLabel& a, const RunLabel& b);

/// Null if no run has this number.
std::shared_ptr<const LiveRun> find_run(RunList runs, std::uint64_t number);

/// The kind of run that all runs of a picture are compared with; empty: the baseline method, in the way of each run.
using RunBase = std::optional<RunLabel>;
/// The one of two runs in turns that is the base: 0 or 1, of the baseline method if only the first is, else the second.
std::size_t base_side(const std::array<RunLabel, 2>& sides);
/// Empty before that was measured, and where it is the usual one: of the baseline method, with the same light sampling.
RunBase base_of_turns(RunList runs, const std::array<RunLabel, 2>& sides);
bool is_base(const RunLabel& label, const RunBase& base);
/// The run that `run` is compared with, the newest of `base`. Of the baseline method: of the same picture, and preferably with the same
/// light sampling and on the same back end; else the newest. Null without one, and for that run itself.
std::shared_ptr<const LiveRun> base_of(RunList runs, const LiveRun& run, const RunBase& base = {});

// Runs at equal cost or equal error: the rows of the table under the plot.

/// A draggable line across the plot.
struct Cursor {
    enum class Kind { None, EqualCost, EqualError };
    Kind kind = Kind::None;
    double at = 0.0;  ///< seconds or samples for EqualCost, else an error

    friend bool operator==(const Cursor&, const Cursor&) = default;
};

/// A run at the cursor. Values beyond its measurements are empty: nothing is extrapolated.
struct CursorRow {
    std::uint64_t run = 0;
    std::optional<double> cost;        ///< in units of the axis
    std::optional<double> other_cost;  ///< samples if the axis is seconds, else seconds
    std::optional<double> error;
    /// Gain over base_of() it: its error at this cost, or its cost at this error, divided by the run's. Above 1 the run
    /// is better; empty for the base.
    std::optional<double> ratio;
    bool is_base = false;
    double measured_from = 0.0;   ///< first and last cost of the run
    double measured_until = 0.0;  ///< an error that was not reached costs more
};

/// Rows of all runs of the picture that have points.
std::vector<CursorRow> cursor_rows(RunList runs, std::uint64_t picture, const CurveKind& kind, const Cursor& cursor,
                                   const RunBase& base = {});

/// Index of the point whose picture represents a run at the cursor, among the points whose picture is kept: the nearest
/// to the cost on a logarithmic axis, or the first from which on the error stays below; without a cursor the newest.
/// Empty before the first point, beyond the end of the run, or without such a picture.
std::optional<std::size_t> point_at(const LiveRun& run, const CurveKind& kind, const Cursor& cursor);

}  // namespace pl::ui
