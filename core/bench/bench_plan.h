// The plan of a bench: the compared scenes, methods, back ends and seeds, the order of the runs, and their settings.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/bench/bench_run.h"
#include "core/bench/reference_store.h"
#include "core/measure/run_recorder.h"
#include "core/scene/description.h"
#include "core/session/backend.h"

namespace pl::bench {

struct BenchScene {
    std::string name;    ///< of its file; distinguishes the scenes of a bench
    std::string source;  ///< as its user names it
    std::shared_ptr<const SceneDescription> description;
    double load_seconds = 0.0;
    RenderSettings settings;                     ///< of every run but for method and seed
    RunLimits limits;                            ///< of every run
    Json options;                                ///< the settings and limits in words, for the plan's file
    std::shared_ptr<const Reference> reference;  ///< null until found or made
};

/// A compared method: with a representation of its own if several are compared, else with that of the scene's settings.
struct BenchMethod {
    std::string name;
    MethodId method = MethodId::Default;
    std::optional<Representation> representation{};

    RenderSettings settings(RenderSettings of_scene) const;
};

struct PlannedRun {
    std::size_t scene = 0;
    std::size_t method = 0;
    std::string backend;
    std::uint64_t seed = 1;
    bool warm_up = false;
};

struct BenchPlan {
    std::vector<BenchScene> scenes;
    std::vector<BenchMethod> methods;  ///< the first one is the baseline of the others
    std::vector<std::string> backend_names;
    std::map<std::string, std::shared_ptr<RenderBackend>> backends;
    std::uint64_t first_seed = 1;
    int seeds = 10;

    /// One run of every cell, all with the same seed, in an order of its own, so that slow changes of the machine
    /// affect all cells alike.
    std::vector<PlannedRun> shuffled_block(int block) const;
    BenchCell cell_of(const PlannedRun& run) const;
    /// Schema "pathlight.bench-plan/1": everything that decides the results. Runs of two different plans are never
    /// mixed.
    Json json() const;
};

}  // namespace pl::bench
