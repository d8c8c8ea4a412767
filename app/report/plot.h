// Plots of a bench as data and as SVG, and text as it stands in HTML and SVG.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/canvas.h"
#include "core/bench/bench_results.h"
#include "core/plot/log_axis.h"

namespace pl {

// Text escaped for HTML and SVG, and bytes as base64.

/// With & < > and quotes replaced, so that names of files and scenes cannot end an element or an attribute.
std::string escape_markup(std::string_view text);

/// [RFC 4648, section 4]
std::string base64(std::string_view bytes);

// A plot as data, and as SVG.

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

/// One curve: its color stands for the method, its line style for the back end.
struct PlotSeries {
    std::string name;
    Rgb color{};
    int style = 0;  ///< 0: full line, 1: dashed, 2: dotted
    std::vector<PlotPoint> line;
    std::vector<BandPoint> band;  ///< 95 % interval; may be empty
};

struct Plot {
    std::string title;
    std::string x_label;
    std::string y_label;
    std::vector<PlotSeries> series;
    double floor = 0.0;  ///< noise of the reference, drawn as a gray area below; 0: none

    /// Axes that hold all positive values.
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

/// Colors that most people with color blindness can tell apart.   [Okabe and Ito 2008]
Rgb method_color(const std::string& method);

std::string svg_plot(const Plot& plot);

// The plots of a bench: error over time and over samples, scene by scene.

struct NamedPlot {
    std::string scene;
    std::string file;  ///< name without suffix: "door-time"
    Plot plot;
};

/// Two plots of every scene. Points are geometric means where all runs are measured, bands the 95 % intervals at
/// equal time or equal samples; no bands below kFewestRuns runs.
std::vector<NamedPlot> convergence_plots(const bench::BenchResults& results);

/// Names of the scenes of a bench in the order of its plan.
std::vector<std::string> scene_order(const Json& plan);

}  // namespace pl
