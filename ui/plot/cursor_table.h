// Runs at equal cost or equal error: the rows of the table under the plot.
#pragma once

#include <optional>
#include <vector>

#include "ui/plot/run_lines.h"

namespace pl::ui {

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
    /// Gain over the baseline: its error at this cost, or its cost at this error, divided by the run's. Above 1 the run
    /// is better; empty for the baseline.
    std::optional<double> ratio;
    bool is_base = false;
    double measured_from = 0.0;   ///< first and last cost of the run
    double measured_until = 0.0;  ///< an error that was not reached costs more
};

/// Rows of all runs of the picture that have points.
std::vector<CursorRow> cursor_rows(RunList runs, std::uint64_t picture, const CurveKind& kind, const Cursor& cursor);

/// Index of the point whose picture represents a run at the cursor, among the points whose picture is kept: the nearest
/// to the cost on a logarithmic axis, or the first from which on the error stays below; without a cursor the newest.
/// Empty before the first point, beyond the end of the run, or without such a picture.
std::optional<std::size_t> point_at(const LiveRun& run, const CurveKind& kind, const Cursor& cursor);

}  // namespace pl::ui
