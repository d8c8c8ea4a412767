// A bench before it runs: its scenes, methods and folder.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/bench/bench_run.h"
#include "core/bench/reference_store.h"
#include "core/io/image.h"
#include "core/measure/run_recorder.h"
#include "core/scene/description.h"
#include "core/session/backend.h"

namespace pl::bench {

// The files of a bench: its plan, one file per finished run, pictures along the way, results and tables.

/// plan.json, runs/, pictures/, references/, results.json and tables.
class BenchFolder {
public:
    explicit BenchFolder(std::filesystem::path path) : path_(std::move(path)) {}

    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path references() const { return path_ / "references"; }

    /// Starts a bench or continues the folder's. Throws Error(Usage) if that has another plan; only the number of
    /// seeds may differ.
    void adopt_plan(const Json& plan) const;

    std::optional<BenchRun> load_run(const BenchCell& cell, std::uint64_t seed) const;
    void save_run(const BenchRun& run) const;
    /// All finished runs, warm-ups too, by cell and seed. Throws Error(Input) if a file is damaged.
    std::vector<BenchRun> all_runs() const;

    /// As half floats.
    void save_picture(const BenchCell& cell, const RunPoint& point, const LinearImage& picture) const;
    std::filesystem::path picture_path(const BenchCell& cell, std::uint32_t spp) const;

    void save_reference_picture(const std::string& scene, const LinearImage& picture) const;
    std::filesystem::path reference_picture_path(const std::string& scene) const;

private:
    std::filesystem::path run_path(const BenchCell& cell, const std::string& which) const;

    std::filesystem::path path_;
};

inline constexpr std::string_view kPlanSchema = "pathlight.bench-plan/1";
inline constexpr std::string_view kResultsSchema = "pathlight.bench/1";

// The plan of a bench: the compared scenes, methods, back ends and seeds, the order of the runs, and their settings.

struct BenchScene {
    std::string name;    ///< of its file or folder; distinguishes the scenes of a bench
    std::string source;  ///< as its user names it
    std::shared_ptr<const SceneDescription> description;
    double load_seconds = 0.0;
    RenderSettings settings;                     ///< of every run, except method and seed
    PictureContent content;                      ///< of the scene with these settings
    RunLimits limits;                            ///< of every run
    Json options;                                ///< the settings and limits in words, for the plan's file
    std::shared_ptr<const Reference> reference;  ///< null until found or made
};

/// A compared method: with a representation of its own if several are compared, else with the representation of the
/// scene's settings.
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
