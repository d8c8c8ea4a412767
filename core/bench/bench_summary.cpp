#include "core/bench/bench_summary.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace pl::bench {
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
        summary.ends.push_back({end.metrics.relmse, static_cast<double>(end.spp), seconds_of(*run)});
        summary.over_time.push_back(run->series.error_over_time());
        summary.over_samples.push_back(run->series.error_over_samples());
        summary.invalid_samples += end.counters.invalid_samples;
        summary.below_reference += end.metrics.relmse > 0.0 ? 0 : 1;
    }
    const auto geometric = [&runs](auto value) { return geometric_interval(values_of(runs, value)); };
    summary.final_error = geometric([](const BenchRun& run) { return run.end().metrics.relmse; });
    summary.final_trimmed = geometric([](const BenchRun& run) { return run.end().metrics.relmse_trimmed; });
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
