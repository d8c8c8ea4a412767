// The page of a bench: one HTML file that needs nothing else, for handing over.
#pragma once

#include <string>

#include "app/measure/bench_results.h"
#include "app/report/convergence_plots.h"

namespace pl {

std::string report_page(const BenchResults& results, const std::vector<NamedPlot>& plots, const Json& pictures);

/// Style and behavior of the page. The script finds the pictures in the element "pictures".
extern const char* const kPageStyle;
extern const char* const kPageScript;

}  // namespace pl
