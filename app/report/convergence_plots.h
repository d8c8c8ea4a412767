// The plots of a bench: error over time and over samples, scene by scene.
#pragma once

#include "app/measure/bench_results.h"
#include "app/report/plot.h"

namespace pl {

struct NamedPlot {
    std::string scene;
    std::string file;  ///< name without suffix: "door-time"
    Plot plot;
};

/// Two plots of every scene. Points are geometric means over runs where all of them were measured, bands the 95 %
/// intervals at equal time or equal samples; below kFewestRuns runs there are none.
std::vector<NamedPlot> convergence_plots(const BenchResults& results);

/// Names of the scenes of a bench in the order of its plan.
std::vector<std::string> scene_order(const Json& plan);

}  // namespace pl
