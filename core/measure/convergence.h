// Error against time of one run, and statistics over several runs: error at a time, time to an error, slope.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/measure/statistics.h"

namespace pl {

/// A point of a run: the cost so far and the error at it.
struct CurvePoint {
    double cost = 0.0;   ///< charged seconds, or samples per pixel
    double error = 0.0;  ///< squared; not positive if it is below the resolution of the reference
};

/// By ascending cost. Errors of one run are strongly correlated: statistics are over runs, never over points.
using Curve = std::vector<CurvePoint>;

/// Error at a cost, interpolated linearly in log-log. Empty outside of the measured range: nothing is extrapolated.
std::optional<double> error_at(const Curve& curve, double cost);

/// Cost from which on the error stays at or below `target`, interpolated alike. Empty if the last point is above it:
/// the run is censored at its last cost.
std::optional<double> cost_to_reach(const Curve& curve, double target);

/// Slope of log error over log cost over the last `decades` of cost; -1 if only noise is left. NaN with fewer than
/// three points.
double log_slope(const Curve& curve, double decades = 1.0);

/// Cost at which several runs reach a target.
struct TimeToTarget {
    Interval cost;  ///< geometric mean over the runs that reach it; NaN if none does
    std::size_t reached = 0;
    std::size_t censored = 0;  ///< runs that do not reach it
    double more_than = 0.0;    ///< the least last cost of censored runs; with any, the true mean is above `cost`
};

TimeToTarget time_to_target(std::span<const Curve> runs, double target);

/// Geometric mean of the error at a cost over all runs; empty unless the cost lies within the measured range of each.
std::optional<Interval> error_interval_at(std::span<const Curve> runs, double cost);

/// Mean slope over runs.
Interval slope_interval(std::span<const Curve> runs);

}  // namespace pl
