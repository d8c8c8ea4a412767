// What runs come to at the same cost or at the same error: the rows of the table under the plot.
#pragma once

#include <optional>
#include <vector>

#include "ui/accuracy/run_lines.h"

namespace pl {

/// A line across the plot that a person drags.
struct Cursor {
    enum class Kind { None, EqualCost, EqualError };
    Kind kind = Kind::None;
    double at = 0.0;  ///< seconds or samples for EqualCost, else an error

    friend bool operator==(const Cursor&, const Cursor&) = default;
};

/// A run where the cursor meets it. What was not measured there is empty: nothing is extrapolated.
struct CursorRow {
    std::uint64_t run = 0;
    std::optional<double> cost;        ///< in units of the axis
    std::optional<double> other_cost;  ///< samples where the axis is seconds, and the other way round
    std::optional<double> error;
    /// Against default: how many times smaller its error is at this cost, or how many times sooner it reached this
    /// error. Above 1 where that counts for the run; empty for the run that is the measure itself.
    std::optional<double> ratio;
    bool is_base = false;
    double measured_from = 0.0;   ///< first and last cost of the run
    double measured_until = 0.0;  ///< an error that was not reached takes more than this
};

/// Rows of all runs of the picture that have points.
std::vector<CursorRow> cursor_rows(RunList runs, std::uint64_t picture, const CurveKind& kind, const Cursor& cursor);

/// Index of the point whose picture stands for a run there: the one nearest to the cost on a logarithmic axis, or the
/// first one from which on the error stays below. Of those only the ones that still have their picture. Without a cursor
/// the newest. Empty before the first point, where the run was not that far, or if it has no such picture.
std::optional<std::size_t> point_at(const LiveRun& run, const CurveKind& kind, const Cursor& cursor);

}  // namespace pl
