// `pathlight bench`: accuracy against time, for methods x back ends x scenes x seeds.
#include "core/bench/bench.h"

#include <optional>

#include <fmt/format.h>

#include "app/commands.h"
#include "app/interrupt.h"
#include "app/make_backend.h"
#include "app/measure/bench_options.h"
#include "app/measure/bench_ranks.h"
#include "app/progress.h"
#include "app/suite.h"
#include "app/version.h"
#include "core/bench/bench_results.h"

namespace pl {
namespace {

/// `typed`: `line` without what its suite and protocol bring.
bench::BenchSettings bench_settings(const CommandLine& line, const CommandLine& typed, Console& console) {
    const Options& options = line.options;
    return {.plan = make_bench_plan(line, console),
            .folder = options.output,
            .reference_folder = options.reference_folder,
            .reference_spp = options.reference_spp,
            .command = repeating_command(typed),
            .commit = std::string(commit_id())};
}

void tell_run(const bench::BenchRun& run, Console& console) {
    console.event("run", {{"scene", run.cell.scene},
                          {"method", run.cell.method},
                          {"backend", run.cell.backend},
                          {"seed", run.seed},
                          {"warm_up", run.warm_up},
                          {"spp", run.end().spp},
                          {"t_render", charged_seconds(run.end().clocks)},
                          {"error", run.end().metrics.relmse}});
}

/// `earlier` are the results of --gate. Returns the exit code.
int report(const bench::BenchResults& results, const std::optional<bench::BenchResults>& earlier,
           const Options& options, Console& console) {
    console.event("done",
                  {{"output", options.output}, {"runs", results.runs.size()}, {"interrupted", !results.complete}});
    if (!results.complete) {
        console.log().warning(
            fmt::format("interrupted: {} runs are kept, the same command continues from there", results.runs.size()));
        return kExitInterrupted;
    }
    console.result(bench::summary_text(results.summary));
    console.remark(
        fmt::format("{}: results.json, series.csv, summary.csv, summary.md, summary.tex\n", options.output));
    if (options.seeds < static_cast<int>(kGoodRuns))
        console.log().notice(
            fmt::format("{} seeds: intervals from fewer than {} runs are rough", options.seeds, kGoodRuns));
    if (earlier)
        console.result(bench::require_gate(bench::gate_rows(*earlier, results, options.tolerance_percent),
                                           options.tolerance_percent));
    return 0;
}

}  // namespace

int run_bench(const CommandLine& typed, Console& console) {
    const CommandLine line = expanded(typed, console);
    const Options& options = line.options;
    const InterruptGuard interrupt;
    std::optional<ProgressDisplay> progress;
    double share = 1.0;
    const auto show = [&](const ProgressState& state) {
        // Each reference, and all runs together, start a bar with a time left of its own.
        if (!progress || state.share < share) progress.emplace(console, !options.no_progress && !options.quiet);
        share = state.share;
        progress->show(state);
    };
    bench::BenchObserver observer{
        .stop = interrupt.flag(),
        .tell = [&](const std::string& work) { console.log().notice("left to do: " + work); },
        .show = show,
        .on_run = [&](const bench::BenchRun& run) { tell_run(run, console); }};
    if (Communicator* const ranks = shared_ranks())
        observer.deal = [&, ranks](const bench::BenchPlan& plan, const std::vector<bench::PlannedRun>& runs,
                                   const bench::OnFinishedRun& on_finished) {
            return deal_runs(*ranks, plan, runs, interrupt.flag(), on_finished);
        };
    bench::Bench bench(bench_settings(line, typed, console), std::move(observer));
    std::optional<bench::BenchResults> earlier;
    if (!options.gate.empty()) earlier = bench::read_results(options.gate);
    const bench::BenchResults results = bench.run();
    progress.reset();
    return report(results, earlier, options, console);
}

}  // namespace pl
