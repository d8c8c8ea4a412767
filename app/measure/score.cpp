// `pathlight score`: pictures of any renderer in the tables of a bench.
#include "core/bench/score.h"

#include <fmt/format.h>

#include "app/commands.h"
#include "app/measure/bench_options.h"

namespace pl {

int run_score(const CommandLine& line, Console& console) {
    const bench::BenchFolder folder(line.options.inputs.front());
    auto [results, warnings] = bench::score_pictures(folder, line.options.threads);
    for (const std::string& warning : warnings) console.log().warning(warning);
    results.command = fmt::format("pathlight score {}", shell_word(line.options.inputs.front()));
    bench::write_results(folder, results);
    console.result(bench::summary_text(results.summary));
    console.remark(
        fmt::format("{}: results.json, series.csv, summary.csv, summary.md, summary.tex\n", folder.path().string()));
    console.event("done", {{"output", folder.path().string()}, {"runs", results.runs.size()}});
    return 0;
}

}  // namespace pl
