// The exports of a bench: results.json with all figures, tables in CSV, Markdown and LaTeX.
#pragma once

#include "core/bench/bench_plan.h"
#include "core/bench/bench_run.h"

namespace pl::bench {

struct BenchResults {
    Json plan;
    std::string command;  ///< the shell command that repeats the bench
    std::string date;     ///< of its end, UTC
    Json references;      ///< by scene: samples per pixel of the halves, and their noise
    std::vector<BenchRun> runs;
    BenchSummary summary;   ///< of the runs
    bool complete = false;  ///< all planned runs are in
};

/// Writes results.json, series.csv, summary.csv, summary.md and summary.tex.
void write_results(const BenchFolder& folder, const BenchResults& results);
/// The time now: "2026-11-29 23:00 UTC".
std::string utc_date();
/// A line for each cell and each comparison, as a terminal shows it.
std::string summary_text(const BenchSummary& summary);
/// Reads results.json of write_results(). Throws Error(Input).
BenchResults read_results(const std::filesystem::path& file);

/// Commits of the programs that made the runs: several if another build continued the bench.
std::vector<std::string> commits_of(const std::vector<BenchRun>& runs);
/// [value, low, high]; numbers that are not finite are null.
Json interval_json(const Interval& interval);
/// "0.0123 (0.0120 to 0.0126)"; without the interval below kFewestRuns runs, "unknown" if there is no value.
std::string interval_text(const Interval& interval, std::size_t runs);
/// The methods of a plan, in its order.
std::vector<std::string> method_order(const Json& plan);

// Comparison of a bench with an earlier one: fails if it is slower by more than the noise.

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
