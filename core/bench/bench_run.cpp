#include "core/bench/bench_run.h"

#include <limits>

#include "core/base/error.h"
#include "core/bench/clocks_json.h"
#include "core/bench/metrics_json.h"

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
    for (const Json& point : json.at("points")) run.series.points.push_back(point_from(point));
    if (run.series.points.empty()) throw Error(ErrorKind::Input, run.cell.title() + ": expected points, got none");
    return run;
}

}  // namespace pl::bench
