// Comparison of a bench with an earlier one: fails if it is slower by more than the noise.
#pragma once

#include "core/bench/bench_results.h"

namespace pl::bench {

struct GateRow {
    BenchCell cell;
    Interval slowdown;  ///< seconds to the same error, new over old
    bool failed = false;
};

/// Cells that both benches have. A row fails only if its whole interval lies above 1 + tolerance, and both sides have
/// kFewestRuns runs. Throws Error(Input) if a scene's picture differs between them, or if they have no cell in
/// common.
std::vector<GateRow> gate_rows(const BenchResults& earlier, const BenchResults& now, double tolerance_percent);

/// One line per row. Throws Error(Threshold) if a row has failed.
std::string require_gate(const std::vector<GateRow>& rows, double tolerance_percent);

}  // namespace pl::bench
