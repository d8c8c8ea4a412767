#include "ui/plot/cursor_table.h"

#include <cmath>
#include <limits>

namespace pl::ui {
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

std::vector<CursorRow> cursor_rows(RunList runs, std::uint64_t picture, const CurveKind& kind, const Cursor& cursor) {
    std::vector<CursorRow> rows;
    if (cursor.kind == Cursor::Kind::None) return rows;
    for (const auto& run : runs) {
        if (run->label.picture != picture || run->points.empty()) continue;
        CursorRow row = row_at(*run, kind, cursor);
        if (const auto base = base_of(runs, *run)) {
            row.ratio = ratio_of(row_at(*base, kind, cursor), row, cursor.kind);
        } else {
            row.is_base = run->label.method == baseline_method();
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
