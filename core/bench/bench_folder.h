// The files of a bench: its plan, one file per finished run, pictures along the way, results and tables.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "core/bench/bench_run.h"
#include "core/io/image.h"

namespace pl::bench {

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

}  // namespace pl::bench
