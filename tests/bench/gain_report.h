// What gain_bench prints, and its file.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/io/json_file.h"
#include "tests/bench/gain_figures.h"
#include "tests/bench/gain_setup.h"
#include "tests/bench/machine_load.h"

namespace pl::benchmarks {

/// Runs of a scene with or without light samples, by method.
struct GainResult {
    std::string scene;
    bool light_samples = false;
    RunLength length;
    std::map<std::string, std::vector<GainRun>>
        runs{};  ///< by name of the method, or "uniform"; `default` is among them
};

void print_gain_header();
/// Rows by method and length: "error" of `default`, with its seconds; gains at equal "samples", with the method's time over
/// the time of `default`; gains at equal "time". With the share of dark paths of the longest run.
void print_gains(const GainResult& result);

inline constexpr const char* kGainSchema = "pathlight.gains/1";

/// All figures of a result, by the names of GainFigures and kErrorNames; intervals are [value, low, high].
Json gains_json(const GainResult& result);
/// The file: settings, load of the machine, and results.
Json gain_file(const GainSetup& setup, const MachineLoad::Shares& load, const Json& results);

}  // namespace pl::benchmarks
