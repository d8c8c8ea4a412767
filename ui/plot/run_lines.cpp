#include "ui/plot/run_lines.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>

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

/// Of runs with other settings than the defaults, told apart by most color-blind people.   [Okabe and Ito 2008]
constexpr std::array<std::uint32_t, 4> kDetailColors{0xffcc79a7u, 0xfff0e442u, 0xffd55e00u, 0xffb8a1ffu};

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
    std::string name(info_of(label.method).label);
    if (!label.details.empty()) name += " (" + label.details + ")";
    name += " " + backend;
    if (label.next_event) name += ", light samples";
    if (label.seed > 1) name += fmt::format(", seed {}", label.seed);
    if (label.warm) name += ", warm";
    return name;
}

std::uint32_t run_color(RunList runs, const RunLabel& label) {
    if (label.details.empty()) return info_of(label.method).color;
    std::vector<std::string> kinds;  // in the order of their first runs
    for (const auto& run : runs)
        if (const RunLabel& other = run->label; other.method == label.method && !other.details.empty() &&
                                                std::ranges::find(kinds, other.details) == kinds.end())
            kinds.push_back(other.details);
    const auto kind = static_cast<std::size_t>(std::ranges::find(kinds, label.details) - kinds.begin());
    return kDetailColors[kind % kDetailColors.size()];
}

bool is_dashed(const RunLabel& label) { return !label.next_event; }

PlotMarker marker_of(const RunLabel& label) { return {.square = label.backend != "cpu", .hollow = label.warm}; }

std::shared_ptr<const LiveRun> find_run(RunList runs, std::uint64_t number) {
    const auto found = std::ranges::find(runs, number, [](const auto& run) { return run->number; });
    return found != runs.end() ? *found : nullptr;
}

bool are_of_one_kind(const RunLabel& a, const RunLabel& b) {
    return a.method == b.method && a.backend == b.backend && a.next_event == b.next_event && a.picture == b.picture &&
           a.details == b.details;
}

namespace {

/// Null before it was measured.
std::shared_ptr<const LiveRun> newest_of_kind(RunList runs, const RunLabel& label) {
    std::shared_ptr<const LiveRun> newest;
    for (const auto& run : runs)
        if (are_of_one_kind(run->label, label) && !run->points.empty()) newest = run;
    return newest;
}

/// The most alike of the baseline method, the newest of these.
std::shared_ptr<const LiveRun> baseline_of(RunList runs, const LiveRun& run) {
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
    return best;
}

}  // namespace

std::size_t base_side(const std::array<RunLabel, 2>& sides) {
    return sides[0].method == baseline_method() && sides[1].method != baseline_method() ? 0 : 1;
}

RunBase base_of_turns(RunList runs, const std::array<RunLabel, 2>& sides) {
    const RunLabel& base = sides[base_side(sides)];
    const bool is_usual = base.method == baseline_method() && sides[0].next_event == sides[1].next_event &&
                          sides[0].method != sides[1].method;
    return !is_usual && newest_of_kind(runs, base) ? RunBase(base) : std::nullopt;
}

bool is_base(const RunLabel& label, const RunBase& base) {
    return base ? are_of_one_kind(label, *base) : label.method == baseline_method();
}

std::shared_ptr<const LiveRun> base_of(RunList runs, const LiveRun& run, const RunBase& base) {
    const auto best = base ? newest_of_kind(runs, *base) : baseline_of(runs, run);
    return best && best->number != run.number ? best : nullptr;
}

namespace {

CursorRow row_at_cost(const LiveRun& run, const CurveKind& kind, double cost) {
    CursorRow row;
    const Curve curve = curve_of(run, kind);
    row.error = error_at(curve, cost);
    row.other_cost = error_at(other_cost_of(run, kind.axis), cost);
    if (row.error) row.cost = cost;
    return row;
}

CursorRow row_at_error(const LiveRun& run, const CurveKind& kind, double error) {
    CursorRow row;
    row.cost = cost_to_reach(curve_of(run, kind), error);
    if (!row.cost) return row;
    row.error = error;
    row.other_cost = error_at(other_cost_of(run, kind.axis), *row.cost);
    return row;
}

CursorRow row_at(const LiveRun& run, const CurveKind& kind, const Cursor& cursor) {
    CursorRow row = cursor.kind == Cursor::Kind::EqualError ? row_at_error(run, kind, cursor.at)
                                                            : row_at_cost(run, kind, cursor.at);
    row.run = run.number;
    row.measured_from = cost_of(run.points.front(), kind.axis);
    row.measured_until = cost_of(run.points.back(), kind.axis);
    return row;
}

std::optional<double> ratio_of(const CursorRow& base, const CursorRow& row, Cursor::Kind kind) {
    const auto& numerator = kind == Cursor::Kind::EqualError ? base.cost : base.error;
    const auto& denominator = kind == Cursor::Kind::EqualError ? row.cost : row.error;
    if (!numerator || !denominator || !(*denominator > 0.0)) return std::nullopt;
    return *numerator / *denominator;
}

/// The first point from which on the error stays at the cursor or below.
std::optional<std::size_t> first_below(const LiveRun& run, const CurveKind& kind, const Cursor& cursor) {
    std::size_t first = run.points.size();
    for (std::size_t i = run.points.size(); i-- > 0;) {
        const auto error = error_of(run.points[i], kind.metric);
        if (!error) continue;  // not measured
        if (!(*error <= cursor.at)) break;
        first = i;
    }
    for (; first < run.points.size(); ++first)
        if (run.points[first].picture != nullptr) return first;
    return std::nullopt;
}

/// The newest without a cursor, else the nearest to its cost.
std::optional<std::size_t> nearest_kept(const LiveRun& run, const CurveKind& kind, const Cursor& cursor) {
    const bool newest = cursor.kind == Cursor::Kind::None;
    if (run.points.empty() || (!newest && cursor.at < cost_of(run.points.front(), kind.axis))) return std::nullopt;
    std::optional<std::size_t> nearest;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < run.points.size(); ++i) {
        if (run.points[i].picture == nullptr) continue;
        const double distance = newest ? 0.0 : std::fabs(std::log(cost_of(run.points[i], kind.axis) / cursor.at));
        if (distance > least) continue;
        least = distance;
        nearest = i;
    }
    return nearest;
}

}  // namespace

std::vector<CursorRow> cursor_rows(RunList runs, std::uint64_t picture, const CurveKind& kind, const Cursor& cursor,
                                   const RunBase& base) {
    std::vector<CursorRow> rows;
    if (cursor.kind == Cursor::Kind::None) return rows;
    for (const auto& run : runs) {
        if (run->label.picture != picture || run->points.empty()) continue;
        CursorRow row = row_at(*run, kind, cursor);
        if (const auto other = base_of(runs, *run, base)) {
            row.ratio = ratio_of(row_at(*other, kind, cursor), row, cursor.kind);
        } else {
            row.is_base = is_base(run->label, base);
        }
        rows.push_back(row);
    }
    return rows;
}

std::optional<std::size_t> point_at(const LiveRun& run, const CurveKind& kind, const Cursor& cursor) {
    if (cursor.kind == Cursor::Kind::EqualError) return first_below(run, kind, cursor);
    return nearest_kept(run, kind, cursor);
}

}  // namespace pl::ui
