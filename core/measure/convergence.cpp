#include "core/measure/convergence.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pl {
namespace {

/// Line through two points in log-log, at `x`.
double interpolate(double x, double x0, double y0, double x1, double y1) {
    if (x0 == x1) return y1;
    const double share = std::log(x / x0) / std::log(x1 / x0);
    return std::exp(std::log(y0) + share * std::log(y1 / y0));
}

bool usable(const CurvePoint& point) { return point.cost > 0.0 && point.error > 0.0; }

}  // namespace

std::optional<double> error_at(const Curve& curve, double cost) {
    for (std::size_t i = 0; i < curve.size(); ++i) {
        if (curve[i].cost < cost) continue;
        if (!usable(curve[i])) return std::nullopt;
        if (curve[i].cost == cost) return curve[i].error;
        if (i == 0 || !usable(curve[i - 1])) return std::nullopt;
        return interpolate(cost, curve[i - 1].cost, curve[i - 1].error, curve[i].cost, curve[i].error);
    }
    return std::nullopt;
}

std::optional<double> cost_to_reach(const Curve& curve, double target) {
    std::size_t first = curve.size();
    while (first > 0 && curve[first - 1].error <= target) --first;
    if (first == curve.size()) return std::nullopt;
    if (first == 0 || !usable(curve[first]) || !usable(curve[first - 1])) return curve[first].cost;
    return interpolate(target, curve[first - 1].error, curve[first - 1].cost, curve[first].error, curve[first].cost);
}

double log_slope(const Curve& curve, double decades) {
    std::vector<double> x;
    std::vector<double> y;
    for (const CurvePoint& point : curve) {
        if (!usable(point) || point.cost < curve.back().cost * std::pow(10.0, -decades)) continue;
        x.push_back(std::log(point.cost));
        y.push_back(std::log(point.error));
    }
    return x.size() < 3 ? std::numeric_limits<double>::quiet_NaN() : line_slope(x, y);
}

TimeToTarget time_to_target(std::span<const Curve> runs, double target) {
    TimeToTarget result;
    std::vector<double> costs;
    for (const Curve& run : runs) {
        if (const auto cost = cost_to_reach(run, target)) {
            costs.push_back(*cost);
            continue;
        }
        const double last = run.empty() ? 0.0 : run.back().cost;
        result.more_than = result.censored == 0 ? last : std::min(result.more_than, last);
        ++result.censored;
    }
    result.reached = costs.size();
    result.cost = geometric_interval(costs);
    return result;
}

std::optional<Interval> error_interval_at(std::span<const Curve> runs, double cost) {
    std::vector<double> errors;
    for (const Curve& run : runs) {
        const auto error = error_at(run, cost);
        if (!error) return std::nullopt;
        errors.push_back(*error);
    }
    if (errors.empty()) return std::nullopt;
    return geometric_interval(errors);
}

Interval slope_interval(std::span<const Curve> runs) {
    std::vector<double> slopes;
    for (const Curve& run : runs) slopes.push_back(log_slope(run));
    return mean_interval(slopes);
}

}  // namespace pl
