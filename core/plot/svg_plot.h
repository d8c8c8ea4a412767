// Plots on logarithmic axes as data, and as SVG files: of a bench, and of the runs in the window.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/plot/log_axis.h"

namespace pl {

struct PlotPoint {
    double x = 0.0;
    double y = 0.0;
    std::string note;  ///< shown when the pointer is on the point
};

struct BandPoint {
    double x = 0.0;
    double low = 0.0;
    double high = 0.0;
};

/// One curve. Values must be positive.
struct PlotSeries {
    std::string name;
    std::uint32_t color = 0xff000000u;  ///< opaque ARGB
    int style = 0;                      ///< 0: full line, 1: dashed, 2: dotted
    std::vector<PlotPoint> line;
    std::vector<BandPoint> band;  ///< 95 % interval; may be empty
};

struct Plot {
    std::string title;
    std::string x_label;
    std::string y_label;
    std::vector<PlotSeries> series;
    double floor = 0.0;                             ///< noise of the reference, drawn as a gray area below; 0: none
    std::optional<LogAxis> x_shown = std::nullopt;  ///< nothing: an axis that holds all values
    std::optional<LogAxis> y_shown = std::nullopt;  ///< nothing: an axis that holds all values

    LogAxis x_axis() const;
    LogAxis y_axis() const;
};

/// Pixels of a plot and of its frame.
struct PlotLayout {
    int width = 760;
    int height = 460;
    int left = 78;
    int right = 190;  ///< room for the legend
    int top = 38;
    int bottom = 54;

    double x(const LogAxis& axis, double value) const { return left + axis.position(value) * (width - left - right); }
    double y(const LogAxis& axis, double value) const {
        return height - bottom - axis.position(value) * (height - top - bottom);
    }
};

/// Curves are clipped to the axes. The file is wider than PlotLayout where the legend needs it.
std::string svg_plot(const Plot& plot);

}  // namespace pl
