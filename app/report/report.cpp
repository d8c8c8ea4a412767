// `pathlight report`: a page of a bench folder, and its plots as SVG.
#include <fmt/format.h>

#include "app/commands.h"
#include "app/report/page.h"
#include "core/io/files.h"

namespace pl {

int run_report(const CommandLine& line, Console& console) {
    const bench::BenchFolder folder(line.options.inputs.front());
    const bench::BenchResults results = bench::read_results(folder.path() / "results.json");
    const std::vector<NamedPlot> plots = convergence_plots(results);
    for (const NamedPlot& plot : plots) write_file_atomic(folder.path() / (plot.file + ".svg"), svg_plot(plot.plot));
    const std::filesystem::path page = folder.path() / "report.html";
    write_file_atomic(page, report_page(results, plots, picture_data(folder, results)));
    console.remark(
        fmt::format("{}: {} runs, {} plots beside it\n", page.string(), results.runs.size(), plots.size()));
    console.event("done", {{"output", page.string()}, {"runs", results.runs.size()}, {"plots", plots.size()}});
    return 0;
}

}  // namespace pl
