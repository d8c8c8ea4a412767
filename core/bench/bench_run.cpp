#include "core/bench/bench_run.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "core/base/error.h"
#include "core/bench/figures_json.h"

namespace pl::bench {
namespace {

Json estimate_json(const std::optional<Estimate>& estimate) {
    if (!estimate) return nullptr;
    return {{"value", estimate->value}, {"error", estimate->error}};
}

Json point_json(const RunPoint& point) {
    const PassCounters& counters = point.counters;
    return {{"spp", point.spp},
            {"seconds", clocks_json(point.clocks, {{"charged", charged_seconds(point.clocks)}})},
            {"metrics", metrics_json(point.metrics)},
            {"noise", point.noise ? Json(*point.noise) : Json(nullptr)},
            {"squared_bias", estimate_json(point.squared_bias)},
            {"signed_bias", estimate_json(point.signed_bias)},
            {"paths", counters.paths},
            {"segments", counters.path.segments},
            {"shadow_rays", counters.path.shadow_rays},
            {"emission_rays", counters.path.emission_rays},
            {"zero_contribution_paths", counters.zero_contribution_paths},
            {"invalid_samples", counters.invalid_samples}};
}

/// JSON has no infinity: it is written as null.
double number_or_infinity(const Json& json) {
    return json.is_null() ? std::numeric_limits<double>::infinity() : json.get<double>();
}

std::optional<Estimate> estimate_from(const Json& json) {
    if (json.is_null()) return std::nullopt;
    return Estimate{json.at("value").get<double>(), number_or_infinity(json.at("error"))};
}

Metrics metrics_from(const Json& json) {
    return {.mse = json.at("mse"),
            .rmse = json.at("rmse"),
            .relmse = json.at("relmse"),
            .mse_trimmed = json.at("mse_trimmed"),
            .relmse_trimmed = json.at("relmse_trimmed"),
            .mape = json.at("mape"),
            .smape = json.at("smape"),
            .bias = json.at("bias"),
            .relative_bias = json.at("relative_bias"),
            .psnr_db = number_or_infinity(json.at("psnr_db")),
            .pixels = json.at("pixels"),
            .invalid = json.at("invalid_pixels"),
            .invalid_reference = json.at("invalid_reference_pixels")};
}

RunPoint point_from(const Json& json) {
    RunPoint point{.spp = json.at("spp"),
                   .clocks = clocks_from(json.at("seconds")),
                   .metrics = metrics_from(json.at("metrics")),
                   .squared_bias = estimate_from(json.at("squared_bias")),
                   .signed_bias = estimate_from(json.at("signed_bias")),
                   .counters = {}};
    if (const Json& noise = json.at("noise"); !noise.is_null()) point.noise = noise.get<double>();
    point.counters.paths = json.at("paths");
    point.counters.path.segments = json.at("segments");
    point.counters.path.shadow_rays = json.at("shadow_rays");
    point.counters.path.emission_rays =
        json.value("emission_rays", std::uint64_t{0});  // absent in results of earlier versions
    point.counters.zero_contribution_paths = json.at("zero_contribution_paths");
    point.counters.invalid_samples = json.at("invalid_samples");
    return point;
}

}  // namespace

Json run_json(const BenchRun& run) {
    Json points = Json::array();
    for (const RunPoint& point : run.series.points) points.push_back(point_json(point));
    Json json{{"schema", kRunSchema},
              {"scene", run.cell.scene},
              {"method", run.cell.method},
              {"backend", run.cell.backend},
              {"seed", run.seed},
              {"learned_before", "nothing"},
              {"warm_up", run.warm_up},
              {"device", run.device},
              {"threads", run.threads},
              {"commit", run.commit},
              {"measure_seconds", run.series.measure_seconds},
              {"points", points}};
    if (!run.host.empty()) json["host"] = run.host;
    if (run.flip) json["flip"] = *run.flip;
    return json;
}

BenchRun run_from_json(const Json& json) {
    BenchRun run{.cell = {json.at("scene"), json.at("method"), json.at("backend")},
                 .seed = json.at("seed"),
                 .warm_up = json.at("warm_up"),
                 .device = json.at("device"),
                 .threads = json.at("threads"),
                 .commit = json.value("commit", "unknown"),
                 .host = json.value("host", ""),
                 .series = {}};
    run.series.measure_seconds = json.at("measure_seconds");
    if (const auto flip = json.find("flip"); flip != json.end()) run.flip = flip->get<double>();
    for (const Json& point : json.at("points")) run.series.points.push_back(point_from(point));
    if (run.series.points.empty()) throw Error(ErrorKind::Input, run.cell.title() + ": expected points, got none");
    return run;
}

namespace {

template <class Value>
std::vector<double> values_of(const std::vector<const BenchRun*>& runs, Value value) {
    std::vector<double> values;
    for (const BenchRun* run : runs) values.push_back(value(*run));
    return values;
}

double mean_of(const std::vector<double>& values) { return mean_interval(values).value; }

double seconds_of(const BenchRun& run) { return charged_seconds(run.end().clocks); }

CellSummary summarize_cell(const BenchCell& cell, const std::vector<const BenchRun*>& runs) {
    CellSummary summary{.cell = cell};
    for (const BenchRun* run : runs) {
        const RunPoint& end = run->end();
        summary.ends.push_back({.error = end.metrics.relmse,
                                .samples = static_cast<double>(end.spp),
                                .seconds = seconds_of(*run),
                                .trimmed_error = end.metrics.relmse_trimmed});
        summary.over_time.push_back(run->series.error_over_time());
        summary.over_samples.push_back(run->series.error_over_samples());
        summary.invalid_samples += end.counters.invalid_samples;
        summary.below_reference += end.metrics.relmse > 0.0 ? 0 : 1;
    }
    const auto geometric = [&runs](auto value) { return geometric_interval(values_of(runs, value)); };
    summary.final_error = geometric([](const BenchRun& run) { return run.end().metrics.relmse; });
    summary.final_trimmed = geometric([](const BenchRun& run) { return run.end().metrics.relmse_trimmed; });
    summary.final_mse = geometric([](const BenchRun& run) { return run.end().metrics.mse; });
    summary.final_flip = mean_interval(values_of(runs, [](const BenchRun& run) { return run.flip.value_or(NAN); }));
    summary.seconds = geometric(seconds_of);
    summary.seconds_per_sample = geometric([](const BenchRun& run) { return seconds_of(run) / run.end().spp; });
    summary.setup_seconds = mean_interval(
        values_of(runs, [](const BenchRun& run) { return run.end().clocks.place + run.end().clocks.precompute; }));
    summary.slope = slope_interval(summary.over_samples);
    summary.signed_bias_interval =
        mean_interval(values_of(runs, [](const BenchRun& run) { return run.end().metrics.relative_bias; }));
    summary.signed_bias = summary.signed_bias_interval.value;
    summary.noise = mean_of(values_of(runs, [](const BenchRun& run) { return run.end().noise.value_or(NAN); }));
    summary.measure_share =
        mean_of(values_of(runs, [](const BenchRun& run) { return run.series.measure_seconds / seconds_of(run); }));
    return summary;
}

std::size_t place_in(const std::vector<std::string>& order, const std::string& method) {
    return static_cast<std::size_t>(std::find(order.begin(), order.end(), method) - order.begin());
}

}  // namespace

const CellSummary* BenchSummary::find(const BenchCell& cell) const {
    for (const CellSummary& summary : cells)
        if (summary.cell == cell) return &summary;
    return nullptr;
}

std::vector<double> BenchSummary::targets(const std::string& scene) const {
    double high = 0.0;
    double low = std::numeric_limits<double>::infinity();
    for (const CellSummary& summary : cells)
        for (const Curve& curve : summary.over_time) {
            if (summary.cell.scene != scene || !(curve.back().error > 0.0)) continue;
            high = std::max(high, curve.back().error);
            low = std::min(low, curve.back().error);
        }
    if (!(high > 0.0) || !std::isfinite(low)) return {};
    // The worst end, the best one, and their mean: methods that miss a target are censored at these.
    return {4.0 * high, high, std::sqrt(high * low), low};
}

BenchSummary summarize(const std::vector<BenchRun>& runs, const std::vector<std::string>& method_order) {
    std::map<std::tuple<std::string, std::string, std::size_t, BenchCell>, std::vector<const BenchRun*>> groups;
    for (const BenchRun& run : runs)
        if (!run.warm_up)
            groups[{run.cell.scene, run.cell.backend, place_in(method_order, run.cell.method), run.cell}].push_back(
                &run);
    BenchSummary summary;
    for (const auto& [key, group] : groups) summary.cells.push_back(summarize_cell(std::get<3>(key), group));
    for (const BenchRun& run : runs)
        for (CellSummary& cell : summary.cells)
            if (run.warm_up && cell.cell == run.cell) cell.warm_up_seconds = seconds_of(run);
    const CellSummary* base = nullptr;
    for (const CellSummary& cell : summary.cells) {
        if (base == nullptr || base->cell.scene != cell.cell.scene || base->cell.backend != cell.cell.backend) {
            base = &cell;
            continue;
        }
        summary.comparisons.push_back(
            {cell.cell, base->cell.method, gain_over(base->ends, cell.ends, base->over_time, cell.over_time)});
    }
    return summary;
}

}  // namespace pl::bench
