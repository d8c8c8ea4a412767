// One finished run of a bench, and its file: an interrupted bench continues from these.
#pragma once

#include <compare>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/io/json_file.h"
#include "core/measure/gain.h"
#include "core/measure/run_recorder.h"

namespace pl::bench {

/// The unit of comparison: runs of the same cell differ in their seeds alone.
struct BenchCell {
    std::string scene;
    std::string method;
    std::string backend;

    auto operator<=>(const BenchCell&) const = default;
    /// "door/reinforcement/cpu"; file_name() is the same with dashes.
    std::string title() const { return scene + "/" + method + "/" + backend; }
    std::string file_name() const { return scene + "-" + method + "-" + backend; }
};

struct BenchRun {
    BenchCell cell;
    std::uint64_t seed = 1;
    bool warm_up = false;  ///< the first of its cell in a process: reported, but left out of summaries
    std::string device;
    int threads = 0;
    std::string commit = "unknown";  ///< of the program that made it
    std::string host{};              ///< that made it, in a job of several processes; else empty
    RunSeries series;
    std::optional<double> flip{};  ///< mean FLIP of the last picture; empty in results of earlier versions

    const RunPoint& end() const { return series.points.back(); }
};

/// Schema "pathlight.run/1", points included.
Json run_json(const BenchRun& run);
/// Throws Json::exception: read_members() turns it into a message.
BenchRun run_from_json(const Json& json);

inline constexpr std::string_view kRunSchema = "pathlight.run/1";

// Statistics over the runs of a bench, cell by cell, and method against method.

/// All runs of a cell but the warm-up.
struct CellSummary {
    BenchCell cell;
    std::vector<RunEnd> ends{};
    std::vector<Curve> over_time{};
    std::vector<Curve> over_samples{};
    Interval final_error{};    ///< relmse at the ends of the runs
    Interval final_trimmed{};  ///< the trimmed relmse at the ends of the runs
    Interval final_mse{};
    Interval final_flip{};  ///< NaN where FLIP was not measured
    Interval seconds{};     ///< charged, to the end
    Interval seconds_per_sample{};
    Interval setup_seconds{};         ///< placing and precomputing; arithmetic, since it may be 0
    Interval slope{};                 ///< of error over samples: -1 where only noise is left
    double signed_bias = 0.0;         ///< mean over runs, over the mean luminance of the reference
    Interval signed_bias_interval{};  ///< over runs
    double noise = 0.0;               ///< mean over runs, each from the halves of its film
    double warm_up_seconds = 0.0;     ///< of the warm-up run; 0 if there is none
    double measure_share = 0.0;       ///< time for measuring over charged time
    std::uint64_t invalid_samples = 0;
    std::size_t below_reference = 0;  ///< runs whose last error is not positive
};

/// A method against the baseline: the first method of the same scene and back end.
struct Comparison {
    BenchCell cell;
    std::string base_method;
    Gain gain;
};

struct BenchSummary {
    std::vector<CellSummary> cells{};  ///< by scene, then back end, then method in the order of the plan
    std::vector<Comparison> comparisons{};

    const CellSummary* find(const BenchCell& cell) const;
    /// Target errors for times to an error: within the range that every method of the scene covers, largest first.
    std::vector<double> targets(const std::string& scene) const;
};

/// `method_order`: the first method in it that has runs is the baseline.
BenchSummary summarize(const std::vector<BenchRun>& runs, const std::vector<std::string>& method_order);

}  // namespace pl::bench
