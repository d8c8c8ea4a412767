#include "ui/plot/plot_lines.h"

#include <algorithm>
#include <cmath>

namespace pl::ui {
namespace {

/// Appends the lowest and the highest point of a stretch, in their order.
void append_extremes(std::span<const LinePoint> stretch, std::vector<LinePoint>& out) {
    if (stretch.empty()) return;
    const auto [low, high] =
        std::ranges::minmax_element(stretch, {}, [](const LinePoint& point) { return point.value.y; });
    out.push_back(std::min(low, high)[0]);
    if (low != high) out.push_back(std::max(low, high)[0]);
}

}  // namespace

std::vector<LinePoint> plot_points(const LiveRun& run, const CurveKind& kind) {
    std::vector<LinePoint> points;
    for (std::size_t i = 0; i < run.points.size(); ++i) {
        const auto error = error_of(run.points[i], kind.metric);
        if (!error) continue;
        const PlotValue value{cost_of(run.points[i], kind.axis), *error};
        if (!can_be_shown(value)) continue;
        // In the logarithm, because errors are skewed: the lower end stays positive.
        const double factor = std::exp(2.0 * error_off(run.points[i], kind.metric) / value.y);
        const bool has_band = factor > 1.0 && std::isfinite(factor);
        points.push_back({value, i, has_band ? value.y / factor : 0.0, has_band ? value.y * factor : 0.0});
    }
    return thin_out(std::move(points), kMostPoints);
}

std::vector<LinePoint> thin_out(std::vector<LinePoint> points, std::size_t most) {
    if (points.size() <= most || most < 4) return points;
    const std::size_t stretches = (most - 2) / 2;
    const double first = std::log(points.front().value.x);
    const double length = std::log(points.back().value.x) - first;
    std::vector<LinePoint> thinned{points.front()};
    std::size_t begin = 1;
    const std::span all(points);
    for (std::size_t stretch = 1; stretch <= stretches; ++stretch) {
        const double end_x = first + length * static_cast<double>(stretch) / static_cast<double>(stretches);
        std::size_t end = begin;
        while (end + 1 < points.size() && (stretch == stretches || std::log(points[end].value.x) <= end_x)) ++end;
        append_extremes(all.subspan(begin, end - begin), thinned);
        begin = end;
    }
    thinned.push_back(points.back());
    return thinned;
}

PlotRange fit_range(std::span<const PlotLine> lines) {
    std::vector<PlotValue> values;
    for (const PlotLine& line : lines)
        if (!line.hidden)
            for (const LinePoint& point : line.points) values.push_back(point.value);
    return fit_range(values);
}

std::optional<PlotHit> nearest_point(std::span<const PlotLine> lines, const PlotView& view, const Rect& frame,
                                     Vec2f pointer, float most_pixels) {
    std::optional<PlotHit> nearest;
    float least = most_pixels;
    for (std::size_t line = 0; line < lines.size(); ++line) {
        if (lines[line].hidden) continue;
        for (std::size_t i = 0; i < lines[line].points.size(); ++i) {
            const Vec2f at = view.to_window(lines[line].points[i].value, frame);
            const float distance = glm::length(at - pointer);
            if (distance > least || !frame.contains(at)) continue;
            least = distance;
            nearest = PlotHit{line, i};
        }
    }
    return nearest;
}

std::vector<Vec2f> dashes(std::span<const Vec2f> line, float on, float off) {
    std::vector<Vec2f> pieces;
    bool is_on = true;
    float left = on;  // of the present dash or gap
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const Vec2f step = line[i + 1] - line[i];
        const float length = glm::length(step);
        float done = 0.0f;
        while (done < length) {
            const float piece = std::min(left, length - done);
            if (is_on) {
                pieces.push_back(line[i] + step * (done / length));
                pieces.push_back(line[i] + step * ((done + piece) / length));
            }
            done += piece;
            left -= piece;
            if (left > 0.0f) break;
            is_on = !is_on;
            left = is_on ? on : off;
        }
    }
    return pieces;
}

}  // namespace pl::ui
