// Error against time of one run, and what several runs say together: error at a time, time to an error, slope.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/measure/statistics.h"

namespace pl {

/// A point of a run: what was spent, and what error was left.
struct CurvePoint {
    double cost = 0.0;   ///< charged seconds, or samples per pixel
    double error = 0.0;  ///< a squared error; points where it is not positive are below what the reference resolves
};

/// By ascending cost. Errors of one run are strongly correlated: statistics are over runs, never over points.
using Curve = std::vector<CurvePoint>;

/// Error at a cost, along straight lines in log-log. Empty outside of what was measured: nothing is extrapolated.
std::optional<double> error_at(const Curve& curve, double cost);

/// Cost from which on the error stays at `target` or below, interpolated alike. Empty if the last point is above it:
/// the run is censored at its last cost.
std::optional<double> cost_to_reach(const Curve& curve, double target);

/// Slope of log error over log cost over the last `decades` of cost; -1 where only noise is left. NaN if fewer than
/// three points lie there.
double log_slope(const Curve& curve, double decades = 1.0);

/// When several runs reached a target.
struct TimeToTarget {
    Interval cost;  ///< of the runs that did, a geometric mean; NaN if none did
    std::size_t reached = 0;
    std::size_t censored = 0;  ///< that did not: counted, never dropped in silence
    double more_than = 0.0;    ///< the least last cost of those; the true mean is above `cost` if there are any
};

TimeToTarget time_to_target(std::span<const Curve> runs, double target);

/// Geometric mean of the error at a cost over all runs; empty unless all of them were measured around it.
std::optional<Interval> error_interval_at(std::span<const Curve> runs, double cost);

/// Mean slope over runs.
Interval slope_interval(std::span<const Curve> runs);

}  // namespace pl
