// The page of a bench: one self-contained HTML file.
#pragma once

#include <string>

#include "app/report/convergence_plots.h"
#include "core/bench/bench_results.h"

namespace pl {

std::string report_page(const bench::BenchResults& results, const std::vector<NamedPlot>& plots,
                        const Json& pictures);

/// Style and behavior of the page. The script finds the pictures in the element "pictures".
extern const char* const kPageStyle;
extern const char* const kPageScript;

}  // namespace pl
