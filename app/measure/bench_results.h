// The exports of a bench: results.json with everything, tables for spreadsheets and for people.
#pragma once

#include "app/measure/bench_folder.h"
#include "app/measure/bench_summary.h"

namespace pl {

/// Writes results.json, series.csv, summary.csv and summary.md. `plan` is repeated in the first; `complete` says
/// whether all planned runs are in.
void write_results(const BenchFolder& folder, const Json& plan, const std::vector<BenchRun>& runs,
                   const BenchSummary& summary, bool complete);

/// What write_results() has written.
struct BenchResults {
    Json plan;
    std::vector<BenchRun> runs;
    BenchSummary summary;
    bool complete = false;
};
/// Throws Error(Input).
BenchResults read_results(const std::filesystem::path& file);

/// [value, low, high]; not finite numbers are null.
Json interval_json(const Interval& interval);
/// "0.0123 (0.0120 to 0.0126)"; without the interval below kFewestRuns runs, "unknown" if there is no value.
std::string interval_text(const Interval& interval, std::size_t runs);
/// The methods of a plan in its order.
std::vector<std::string> method_order(const Json& plan);

}  // namespace pl
