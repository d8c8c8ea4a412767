// What a bench compares, and in which order: everything that is known before the first run.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "app/console.h"
#include "app/measure/bench_run.h"
#include "app/measure/reference_store.h"
#include "app/open_scene.h"
#include "app/options.h"

namespace pl {

struct BenchScene {
    std::string name;  ///< of its file
    LoadedScene loaded;
    Options options;                             ///< resolved for this scene
    std::shared_ptr<const Reference> reference;  ///< null until found or made
};

struct PlannedRun {
    std::size_t scene = 0;
    MethodId method = MethodId::Default;
    std::string backend;
    std::uint64_t seed = 1;
    bool warm_up = false;
};

struct BenchPlan {
    std::vector<BenchScene> scenes;
    std::vector<MethodId> methods;  ///< the first one is what others are held against
    std::vector<std::string> backend_names;
    std::map<std::string, std::shared_ptr<RenderBackend>> backends;
    std::uint64_t first_seed = 1;
    int seeds = 10;

    /// One run of everything that is compared, all with the same seed, in an order of its own: slow changes of the
    /// machine then fall on all alike.
    std::vector<PlannedRun> shuffled_block(int block) const;
    BenchCell cell_of(const PlannedRun& run) const;
    /// What decides the numbers, schema "pathlight.bench-plan/1"; runs of another plan do not go with them.
    Json json() const;
};

/// Opens scenes and back ends. Throws Error(Usage) also for two scenes of one name.
BenchPlan make_bench_plan(const CommandLine& line, Console& console);

/// The shell command that repeats a bench in any folder.
std::string repeating_command(const CommandLine& line);

}  // namespace pl
