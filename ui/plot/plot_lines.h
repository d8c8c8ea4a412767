// The drawing of a plot of runs, as data: lines in the units of the axes, thinned to the visible points, and which of their
// points is nearest to the pointer.
#pragma once

#include <string>
#include <vector>

#include "ui/plot/plot_view.h"
#include "ui/plot/run_lines.h"

namespace pl::ui {

struct LinePoint {
    PlotValue value;
    std::size_t index = 0;  ///< of the point in its run
    double low = 0.0;       ///< band: two standard errors over the run's own blocks; 0 and 0 without a band
    double high = 0.0;
};

struct PlotLine {
    std::uint64_t run = 0;
    std::string name;
    std::uint32_t color = 0;  ///< opaque ARGB
    bool is_dashed = false;
    PlotMarker marker;
    bool hidden = false;
    bool in_progress = false;
    std::vector<LinePoint> points;
};

/// Most points of a drawn line, which always has the first and the last point of its run.
inline constexpr std::size_t kMostPoints = 500;

/// The points of a run on logarithmic axes: both values positive and finite. At most kMostPoints: the lowest and the
/// highest point of each of equal intervals of log x.
std::vector<LinePoint> plot_points(const LiveRun& run, const CurveKind& kind);
std::vector<LinePoint> thin_out(std::vector<LinePoint> points, std::size_t most);

/// Range of all lines that are not hidden.
PlotRange fit_range(std::span<const PlotLine> lines);

struct PlotHit {
    std::size_t line = 0;
    std::size_t point = 0;
};
/// The point nearest to `pointer`, among those within `most_pixels` and inside `frame`.
std::optional<PlotHit> nearest_point(std::span<const PlotLine> lines, const PlotView& view, const Rect& frame,
                                     Vec2f pointer, float most_pixels);

/// A dashed line: pieces of `on` pixels with gaps of `off` pixels, both positive, as pairs of points.
std::vector<Vec2f> dashes(std::span<const Vec2f> line, float on, float off);

}  // namespace pl::ui
