#include "core/bench/bench_results.h"

#include <cmath>
#include <ctime>
#include <map>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/printable.h"
#include "core/bench/figures_json.h"
#include "core/io/files.h"

namespace pl::bench {
namespace {

Json number_json(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json optional_json(const std::optional<double>& value) { return value ? number_json(*value) : Json(nullptr); }

Json cell_json(const BenchCell& cell) {
    return {{"scene", cell.scene}, {"method", cell.method}, {"backend", cell.backend}};
}

Json targets_json(const CellSummary& summary, const std::vector<double>& targets) {
    Json rows = Json::array();
    for (const double target : targets) {
        const TimeToTarget time = time_to_target(summary.over_time, target);
        rows.push_back({{"relmse", target},
                        {"seconds", interval_json(time.cost)},
                        {"reached", time.reached},
                        {"censored", time.censored},
                        {"more_than_seconds", time.censored > 0 ? Json(time.more_than) : Json(nullptr)}});
    }
    return rows;
}

Json summary_json(const BenchSummary& summary) {
    Json cells = Json::array();
    for (const CellSummary& cell : summary.cells) {
        Json row = cell_json(cell.cell);
        row.update({{"runs", cell.ends.size()},
                    {"relmse", interval_json(cell.final_error)},
                    {"relmse_trimmed", interval_json(cell.final_trimmed)},
                    {"mse", interval_json(cell.final_mse)},
                    {"flip", interval_json(cell.final_flip)},
                    {"seconds", interval_json(cell.seconds)},
                    {"seconds_per_sample", interval_json(cell.seconds_per_sample)},
                    {"setup_seconds", interval_json(cell.setup_seconds)},
                    {"slope", interval_json(cell.slope)},
                    {"relative_bias", interval_json(cell.signed_bias_interval)},
                    {"noise", number_json(cell.noise)},
                    {"warm_up_seconds", cell.warm_up_seconds},
                    {"measure_share", number_json(cell.measure_share)},
                    {"invalid_samples", cell.invalid_samples},
                    {"runs_below_reference", cell.below_reference},
                    {"time_to", targets_json(cell, summary.targets(cell.cell.scene))}});
        cells.push_back(row);
    }
    return cells;
}

Json comparisons_json(const BenchSummary& summary) {
    Json rows = Json::array();
    for (const Comparison& comparison : summary.comparisons) {
        Json row = cell_json(comparison.cell);
        const Gain& gain = comparison.gain;
        row.update({{"base", comparison.base_method},
                    {"runs", gain.runs},
                    {"samples", interval_json(gain.samples)},
                    {"cost", interval_json(gain.cost)},
                    {"net", interval_json(gain.net)},
                    {"net_trimmed", interval_json(gain.net_trimmed)},
                    {"ahead_from_seconds", optional_json(gain.ahead_from_seconds)},
                    {"compared_until_seconds", gain.compared_until_seconds},
                    {"headline", headline(gain, comparison.base_method)}});
        rows.push_back(row);
    }
    return rows;
}

std::string csv_number(double value) { return std::isfinite(value) ? fmt::format("{:.9g}", value) : ""; }

std::string csv_cell(const BenchCell& cell) {
    return fmt::format("{},{},{}", csv_text(cell.scene), csv_text(cell.method), csv_text(cell.backend));
}

std::string series_csv(const std::vector<BenchRun>& runs) {
    std::string text =
        "scene,method,backend,seed,warm_up,spp,load_s,build_s,upload_s,place_s,precompute_s,learn_s,render_s,"
        "charged_s,mse,relmse,relmse_trimmed,mape,smape,bias,relative_bias,psnr_db,noise,squared_bias,"
        "squared_bias_error,paths,segments,zero_contribution_paths,invalid_samples,invalid_pixels\n";
    for (const BenchRun& run : runs)
        for (const RunPoint& point : run.series.points) {
            const Clocks& t = point.clocks;
            const Metrics& m = point.metrics;
            text += fmt::format("{},{},{},{}", csv_cell(run.cell), run.seed, run.warm_up ? 1 : 0, point.spp);
            for (const double value :
                 {t.load, t.build, t.upload, t.place, t.precompute, t.learn, t.render, charged_seconds(t), m.mse,
                  m.relmse, m.relmse_trimmed, m.mape, m.smape, m.bias, m.relative_bias, m.psnr_db,
                  point.noise.value_or(NAN), point.squared_bias ? point.squared_bias->value : NAN,
                  point.squared_bias ? point.squared_bias->error : NAN})
                text.append(1, ',').append(csv_number(value));
            text += fmt::format(",{},{},{},{},{}\n", point.counters.paths, point.counters.path.segments,
                                point.counters.zero_contribution_paths, point.counters.invalid_samples, m.invalid);
        }
    return text;
}

std::string summary_csv(const BenchSummary& summary) {
    std::string text = "scene,method,backend,runs,relmse,relmse_low,relmse_high,seconds,seconds_per_sample,"
                       "setup_seconds,slope,slope_low,slope_high,base,samples_factor,cost_factor,net_factor,net_low,"
                       "net_high,ahead_from_seconds,mse,flip\n";
    for (const CellSummary& cell : summary.cells) {
        text += fmt::format("{},{}", csv_cell(cell.cell), cell.ends.size());
        for (const double value : {cell.final_error.value, cell.final_error.low, cell.final_error.high,
                                   cell.seconds.value, cell.seconds_per_sample.value, cell.setup_seconds.value,
                                   cell.slope.value, cell.slope.low, cell.slope.high})
            text.append(1, ',').append(csv_number(value));
        std::string gain_columns = ",,,,,,,";
        for (const Comparison& comparison : summary.comparisons) {
            if (comparison.cell != cell.cell) continue;
            const Gain& gain = comparison.gain;
            gain_columns = fmt::format(",{}", csv_text(comparison.base_method));
            for (const double value : {gain.samples.value, gain.cost.value, gain.net.value, gain.net.low,
                                       gain.net.high, gain.ahead_from_seconds.value_or(NAN)})
                gain_columns.append(1, ',').append(csv_number(value));
        }
        text += fmt::format("{},{},{}\n", gain_columns, csv_number(cell.final_mse.value),
                            csv_number(cell.final_flip.value));
    }
    return text;
}

std::string summary_markdown(const BenchSummary& summary) {
    std::string text =
        "| scene | back end | method | runs | relMSE at the end | MSE | FLIP | seconds | ms per sample | slope |\n"
        "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n";
    for (const CellSummary& cell : summary.cells) {
        const std::size_t runs = cell.ends.size();
        text += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {:.3g} | {} |\n", cell.cell.scene,
                            cell.cell.backend, cell.cell.method, runs, interval_text(cell.final_error, runs),
                            interval_text(cell.final_mse, runs), interval_text(cell.final_flip, runs),
                            interval_text(cell.seconds, runs), 1e3 * cell.seconds_per_sample.value,
                            interval_text(cell.slope, runs));
    }
    text += "\n";
    for (const Comparison& comparison : summary.comparisons)
        text += fmt::format("* {}, {}: {} {}\n", comparison.cell.scene, comparison.cell.backend,
                            comparison.cell.method, headline(comparison.gain, comparison.base_method));
    return text;
}

/// A table of package booktabs: errors, and gains over the first method.
std::string summary_latex(const BenchSummary& summary) {
    std::string text =
        "\\begin{tabular}{lllrrr}\n\\toprule\n"
        "scene & back end & method & relMSE & fewer samples & less time to the same error \\\\\n\\midrule\n";
    for (const CellSummary& cell : summary.cells) {
        std::string gains = "&";
        for (const Comparison& comparison : summary.comparisons)
            if (comparison.cell == cell.cell)
                gains = fmt::format("{} & {}", interval_text(comparison.gain.samples, comparison.gain.runs),
                                    interval_text(comparison.gain.net, comparison.gain.runs));
        text +=
            fmt::format("{} & {} & {} & {} & {} \\\\\n", latex_text(cell.cell.scene), latex_text(cell.cell.backend),
                        latex_text(cell.cell.method), interval_text(cell.final_error, cell.ends.size()), gains);
    }
    return text + "\\bottomrule\n\\end{tabular}\n";
}

}  // namespace

std::vector<std::string> commits_of(const std::vector<BenchRun>& runs) {
    std::set<std::string> commits;
    for (const BenchRun& run : runs) commits.insert(run.commit);
    return {commits.begin(), commits.end()};
}

Json interval_json(const Interval& interval) {
    return Json::array({number_json(interval.value), number_json(interval.low), number_json(interval.high)});
}

std::string interval_text(const Interval& interval, std::size_t runs) {
    if (!std::isfinite(interval.value)) return "unknown";
    if (runs < kFewestRuns || !std::isfinite(interval.low) || !std::isfinite(interval.high))
        return fmt::format("{:.3g}", interval.value);
    return pl::interval_text(interval);
}

std::vector<std::string> method_order(const Json& plan) { return plan.at("methods").get<std::vector<std::string>>(); }

void write_results(const BenchFolder& folder, const BenchResults& results) {
    Json runs = Json::array();
    for (const BenchRun& run : results.runs) runs.push_back(run_json(run));
    write_json_file(folder.path() / "results.json",
                    {{"schema", kResultsSchema},
                     {"version", PL_VERSION},
                     {"commits", commits_of(results.runs)},
                     {"complete", results.complete},
                     {"command", results.command},
                     {"date", results.date},
                     {"definitions",
                      {{"metrics", metric_definitions()},
                       {"charged_seconds", "place + precompute + learn + render, on the steady clock of the host"},
                       {"noise", "relmse of the picture's own noise, from two halves of its passes"},
                       {"intervals", "95 %, Student on logarithms over runs; ratios by Welch"}}},
                     {"plan", results.plan},
                     {"references", results.references},
                     {"summary", summary_json(results.summary)},
                     {"comparisons", comparisons_json(results.summary)},
                     {"runs", runs}});
    write_file_atomic(folder.path() / "series.csv", series_csv(results.runs));
    write_file_atomic(folder.path() / "summary.csv", summary_csv(results.summary));
    write_file_atomic(folder.path() / "summary.md", summary_markdown(results.summary));
    write_file_atomic(folder.path() / "summary.tex", summary_latex(results.summary));
}

std::string utc_date() {
    const std::time_t now = std::time(nullptr);
    std::tm parts{};
    gmtime_r(&now, &parts);
    char text[32];
    return {text, std::strftime(text, sizeof(text), "%Y-%m-%d %H:%M UTC", &parts)};
}

std::string summary_text(const BenchSummary& summary) {
    std::string text;
    for (const CellSummary& cell : summary.cells) {
        const std::size_t runs = cell.ends.size();
        text += fmt::format("{:<40} relMSE {}, {} s, {} runs\n", cell.cell.title(),
                            interval_text(cell.final_error, runs), interval_text(cell.seconds, runs), runs);
    }
    for (const Comparison& comparison : summary.comparisons)
        text += fmt::format("{} {}\n", comparison.cell.title(), headline(comparison.gain, comparison.base_method));
    return text;
}

BenchResults read_results(const std::filesystem::path& file) {
    const Json json = read_json_file(file, kResultsSchema);
    return read_members(file, [&] {
        BenchResults results{.plan = json.at("plan"),
                             .command = json.at("command"),
                             .date = json.at("date"),
                             .references = json.at("references"),
                             .runs = {},
                             .summary = {},
                             .complete = json.at("complete")};
        for (const Json& run : json.at("runs")) results.runs.push_back(run_from_json(run));
        results.summary = summarize(results.runs, method_order(results.plan));
        return results;
    });
}

namespace {

std::map<std::string, std::string> picture_hashes(const Json& plan) {
    std::map<std::string, std::string> hashes;
    for (const Json& scene : plan.at("scenes")) hashes[scene.at("name")] = scene.at("picture_hash");
    return hashes;
}

std::vector<double> errors_times_seconds(const CellSummary& cell) {
    std::vector<double> values;
    for (const RunEnd& end : cell.ends) values.push_back(end.error_seconds());
    return values;
}

}  // namespace

std::vector<GateRow> gate_rows(const BenchResults& earlier, const BenchResults& now, double tolerance_percent) {
    auto hashes = picture_hashes(earlier.plan);
    for (const auto& [scene, hash] : picture_hashes(now.plan))
        if (hashes.contains(scene) && hashes.at(scene) != hash)
            throw Error(ErrorKind::Input,
                        fmt::format("--gate: {} has another picture hash than before: scene, camera, size, "
                                    "light or depth have changed",
                                    scene));
    std::vector<GateRow> rows;
    for (const CellSummary& cell : now.summary.cells) {
        const CellSummary* const old = earlier.summary.find(cell.cell);
        if (old == nullptr) continue;
        GateRow row{.cell = cell.cell,
                    .slowdown = ratio_interval(errors_times_seconds(cell), errors_times_seconds(*old))};
        row.failed = old->ends.size() >= kFewestRuns && cell.ends.size() >= kFewestRuns &&
                     row.slowdown.low > 1.0 + 0.01 * tolerance_percent;
        rows.push_back(row);
    }
    if (rows.empty())
        throw Error(ErrorKind::Input,
                    "--gate: the earlier results have no scene, method and back end in common with these");
    return rows;
}

std::string require_gate(const std::vector<GateRow>& rows, double tolerance_percent) {
    std::string text;
    std::string failed;
    for (const GateRow& row : rows) {
        text += fmt::format("gate {}: takes {:.3g} times as long to the same error (95 %: {:.3g} to {:.3g}){}\n",
                            row.cell.title(), row.slowdown.value, row.slowdown.low, row.slowdown.high,
                            row.failed ? ", FAILED" : "");
        if (row.failed) failed += (failed.empty() ? "" : ", ") + row.cell.title();
    }
    if (!failed.empty())
        throw Error(ErrorKind::Threshold,
                    fmt::format("--gate: slower by more than {} %: {}\n{}", tolerance_percent, failed, text));
    return text;
}

}  // namespace pl::bench
