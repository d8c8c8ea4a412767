// What the runs of a bench say together, cell by cell and method against method.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "app/measure/bench_run.h"
#include "core/measure/gain.h"

namespace pl {

/// All runs of a cell but the warm-up.
struct CellSummary {
    BenchCell cell;
    std::vector<RunEnd> ends{};
    std::vector<Curve> over_time{};
    std::vector<Curve> over_samples{};
    Interval final_error{};    ///< relmse where the runs end
    Interval final_trimmed{};  ///< its trimmed twin
    Interval seconds{};        ///< charged, to the end
    Interval seconds_per_sample{};
    Interval setup_seconds{};         ///< placing and precomputing; arithmetic, since it may be 0
    Interval slope{};                 ///< of error over samples: -1 where only noise is left
    double signed_bias = 0.0;         ///< mean over runs, over the mean luminance of the reference
    Interval signed_bias_interval{};  ///< over runs
    double noise = 0.0;               ///< mean over runs of what their halves say
    double warm_up_seconds = 0.0;     ///< of the run that was left out; 0 if there is none
    double measure_share = 0.0;       ///< time spent on measuring over charged time
    std::uint64_t invalid_samples = 0;
    std::size_t below_reference = 0;  ///< runs whose last error is not positive
};

struct TargetRow {
    double error = 0.0;
    TimeToTarget time;
};

/// A method against the first one of the same scene and back end.
struct Comparison {
    BenchCell cell;
    std::string base_method;
    Gain gain;
};

struct BenchSummary {
    std::vector<CellSummary> cells{};  ///< by scene, then back end, then method in the order of the plan
    std::vector<Comparison> comparisons{};

    const CellSummary* find(const BenchCell& cell) const;
    /// Errors worth asking the time to: within what every method of the scene covers, largest first.
    std::vector<double> targets(const std::string& scene) const;
};

/// `method_order` says which method others are held against: the first one that was measured.
BenchSummary summarize(const std::vector<BenchRun>& runs, const std::vector<std::string>& method_order);

}  // namespace pl
