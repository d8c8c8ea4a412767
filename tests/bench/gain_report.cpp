#include "tests/bench/gain_report.h"

#include <cmath>
#include <cstdio>

#include <fmt/format.h>

#include "core/bench/bench_results.h"

namespace pl::benchmarks {
namespace {

const std::string kBase{info_of(MethodId::Default).name};

std::string text_of(const Interval& interval) {
    if (!std::isfinite(interval.value)) return "-";
    if (!std::isfinite(interval.low)) return fmt::format("{:.3g}", interval.value);
    return fmt::format("{:.3g} [{:.3g}, {:.3g}]", interval.value, interval.low, interval.high);
}

/// Words before the numbers of a row.
struct RowName {
    const GainResult& result;
    const std::string& method;
    const std::string& length;
};

void print_row(const RowName& name, const char* kind, const Intervals& values, const Interval& time) {
    std::string row = fmt::format("{:<14} {:<5} {:<13} {:>5} {:<7}", name.result.scene,
                                  name.result.light_samples ? "on" : "off", name.method, name.length, kind);
    for (const Interval& value : values) row += fmt::format(" {:<22}", text_of(value));
    if (std::isfinite(time.value))
        row += fmt::format(" {:>5.3g} {:>5.3f}", time.value, name.result.runs.at(name.method).front().dark_share);
    std::printf("%s\n", row.substr(0, row.find_last_not_of(' ') + 1).c_str());
}

bool has_values(const Intervals& values) {
    for (const Interval& value : values)
        if (std::isfinite(value.value)) return true;
    return false;
}

Json intervals_json(const Intervals& values) {
    Json json = Json::object();
    for (std::size_t error = 0; error < values.size(); ++error)
        json[kErrorNames[error]] = bench::interval_json(values[error]);
    return json;
}

Json run_json(const GainRun& run) {
    Json points = Json::array();
    for (const Checkpoint& point : run.points) {
        Json json{{"samples", point.samples}, {"seconds", point.seconds}};
        for (std::size_t error = 0; error < point.errors.size(); ++error)
            json[kErrorNames[error]] = point.errors[error];
        points.push_back(json);
    }
    return {{"seed", run.seed}, {"dark_share", run.dark_share}, {"points", points}};
}

Json method_json(const GainResult& result, const std::string& method, const std::vector<GainRun>& runs) {
    Json json{{"method", method}, {"lengths", Json::array()}, {"runs", Json::array()}};
    for (const GainFigures& figures : gain_figures(result.runs.at(kBase), runs, result.length)) {
        Json row{{"length", figures.length}};
        if (method == kBase) {
            row["errors"] = intervals_json(figures.base_errors);
            row["seconds"] = bench::interval_json(figures.base_seconds);
        } else {
            row["equal_samples"] = intervals_json(figures.equal_samples);
            row["equal_time"] = intervals_json(figures.equal_time);
            row["slowdown"] = bench::interval_json(figures.slowdown);
        }
        json["lengths"].push_back(row);
    }
    for (const GainRun& run : runs) json["runs"].push_back(run_json(run));
    return json;
}

}  // namespace

void print_gain_header() {
    std::printf("%-14s %-5s %-13s %5s %-7s %-22s %-22s %-22s %-22s %-22s %-22s %5s %5s\n", "scene", "light", "method",
                "at", "equal", "MSE", "-0.1 %", "-1 %", "relMSE", "-0.1 %", "-1 %", "time", "dark");
}

void print_gains(const GainResult& result) {
    for (const auto& [method, runs] : result.runs)
        for (const GainFigures& figures : gain_figures(result.runs.at(kBase), runs, result.length)) {
            const RowName name{result, method, figures.length};
            if (method == kBase) {
                print_row(name, "error", figures.base_errors, figures.base_seconds);
                continue;
            }
            if (has_values(figures.equal_samples))
                print_row(name, "samples", figures.equal_samples, figures.slowdown);
            if (has_values(figures.equal_time)) print_row(name, "time", figures.equal_time, {NAN, NAN, NAN});
        }
    std::fflush(stdout);
}

Json gains_json(const GainResult& result) {
    Json json{{"scene", result.scene}, {"light_samples", result.light_samples}, {"methods", Json::array()}};
    for (const auto& [method, runs] : result.runs) json["methods"].push_back(method_json(result, method, runs));
    return json;
}

Json gain_file(const GainSetup& setup, const MachineLoad::Shares& load, const Json& results) {
    return {{"schema", kGainSchema},
            {"settings", setup.numbers},
            {"processors", {{"own", load.own}, {"others", load.foreign}, {"stolen", load.stolen}}},
            {"results", results}};
}

}  // namespace pl::benchmarks
