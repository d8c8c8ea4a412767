// What a plot of runs draws, as data: lines in the units of the axes, thinned to what can be seen, and which of their
// points is nearest to the pointer.
#pragma once

#include <string>
#include <vector>

#include "ui/plot/plot_view.h"
#include "ui/plot/run_lines.h"

namespace pl {

struct PlotPoint {
    PlotValue value;
    std::size_t index = 0;  ///< of the point in its run
    double low = 0.0;  ///< band around it: two standard errors over this run's own blocks; 0 and 0: there is none
    double high = 0.0;
};

struct PlotLine {
    std::uint64_t run = 0;
    std::string name;
    std::uint32_t color = 0;  ///< opaque ARGB
    LineStyle style = LineStyle::Full;
    bool warm = false;
    bool comparable = true;  ///< shows the picture that is in the window; others are gray
    bool hidden = false;
    bool in_progress = false;
    std::vector<PlotPoint> points;
};

/// Of what is drawn in one line at most; the first and the last point always are.
inline constexpr std::size_t kMostPoints = 500;

/// The points that can be shown on logarithmic axes: both numbers positive and finite. At most kMostPoints: of each of as
/// many equal stretches of log x the lowest and the highest.
std::vector<PlotPoint> plot_points(const LiveRun& run, const CurveKind& kind);
std::vector<PlotPoint> thin_out(std::vector<PlotPoint> points, std::size_t most);

/// Range of all lines that are shown and comparable; of those that are shown if none is comparable.
PlotRange fit_range(std::span<const PlotLine> lines);

struct PlotHit {
    std::size_t line = 0;
    std::size_t point = 0;
};
/// The point nearest to `pointer`, among those within `most_pixels` and inside `frame`.
std::optional<PlotHit> nearest_point(std::span<const PlotLine> lines, const PlotView& view, const Rect& frame,
                                     Vec2f pointer, float most_pixels);

/// A line in pieces of `on` pixels with gaps of `off` pixels, both positive: pairs of points.
std::vector<Vec2f> dashes(std::span<const Vec2f> line, float on, float off);

}  // namespace pl
