// Settings of gain_bench: the words of its command line.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/session/settings.h"
#include "tests/bench/gain_run.h"

namespace pl::benchmarks {

struct GainSetup {
    /// Keys with numbers.
    std::map<std::string, double> numbers{
        {"spp", 512},        {"short", 128},    {"seconds", 0.7},
        {"seeds", 5},        {"side", 128},     {"width", 0},
        {"height", 0},       {"nee", 2},        {"precomputed", 1},
        {"reference", 1024}, {"threads", 2},    {"volumes", 0},
        {"bins", 256},       {"fraction", 0},   {"floor", kUniformShare},
        {"rate", 4},         {"precompute", 0}, {"megabytes", 16.0},
        {"target", 0},       {"light", 1},      {"roulette", 0},
        {"guiding", 0},      {"uniform", 0},    {"refine", kRefineByRecords},
        {"field", 0},
    };
    /// Keys with words: folders and a file.
    std::map<std::string, std::string> words{
        {"references", PL_BENCH_REFERENCES},
        {"larger", PL_SOURCE_DIR "/../shared/scenes"},
        {"json", ""},
    };
    std::vector<std::string> scenes;  ///< names or files

    double operator[](const std::string& key) const { return numbers.at(key); }
    int integer(const std::string& key) const { return static_cast<int>(numbers.at(key)); }
    int width() const { return integer(numbers.at("width") > 0.0 ? "width" : "side"); }
    int height() const { return integer(numbers.at("height") > 0.0 ? "height" : "side"); }

    /// Samples per pixel at which results are wanted, ascending: `short` unless it is `spp` or more, and `spp`.
    RunLength run_length() const;
    /// Whether to measure with light samples: off, on.
    std::vector<bool> light_samples() const;
    std::vector<MethodId> methods() const;
};

/// Throws Error(Usage) for an unknown key. The scene "all" becomes all of assets/scenes and the larger ones that are there.
GainSetup parse_gain_setup(int count, char** words);

/// For every run but for method, seed and light samples.
RenderSettings settings_of(const GainSetup& setup, const SceneDescription& scene);

}  // namespace pl::benchmarks
