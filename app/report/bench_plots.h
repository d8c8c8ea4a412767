// The plots of a bench: error over time and over samples, scene by scene.
#pragma once

#include <string>
#include <vector>

#include "core/bench/bench_results.h"
#include "core/plot/svg_plot.h"

namespace pl {

/// Opaque ARGB, of colors that most people with color blindness can tell apart.   [Okabe and Ito 2008]
std::uint32_t method_color(const std::string& method);

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
