// Statistics over the runs of a bench, cell by cell, and method against method.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/bench/bench_run.h"
#include "core/measure/gain.h"

namespace pl::bench {

/// All runs of a cell but the warm-up.
struct CellSummary {
    BenchCell cell;
    std::vector<RunEnd> ends{};
    std::vector<Curve> over_time{};
    std::vector<Curve> over_samples{};
    Interval final_error{};    ///< relmse at the ends of the runs
    Interval final_trimmed{};  ///< the trimmed relmse at the ends of the runs
    Interval seconds{};        ///< charged, to the end
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

struct TargetRow {
    double error = 0.0;
    TimeToTarget time;
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
