// Whether a bench has become slower than an earlier one: noise must not fail a build.
#pragma once

#include "app/measure/bench_results.h"

namespace pl {

struct GateRow {
    BenchCell cell;
    Interval slowdown;  ///< seconds to the same error, new over old
    bool failed = false;
};

/// Cells of both benches. A row fails only if its whole interval lies above 1 + tolerance, and both sides have
/// kFewestRuns runs. Throws Error(Input) if a scene's picture is not the same in both, or nothing is common.
std::vector<GateRow> gate_rows(const BenchResults& earlier, const BenchResults& now, double tolerance_percent);

/// One line per row. Throws Error(Threshold) if a row has failed.
std::string require_gate(const std::vector<GateRow>& rows, double tolerance_percent);

}  // namespace pl
