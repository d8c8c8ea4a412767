// Gains of a method over default path tracing, at equal samples and at equal time, with intervals over seeds.
#pragma once

#include <string>
#include <vector>

#include "core/measure/statistics.h"
#include "tests/bench/gain_run.h"

namespace pl::benchmarks {

using Intervals = std::array<Interval, kErrorNames.size()>;

/// Gains at one length. Those that cannot be told are NaN: a picture that is not there yet, a length in seconds for
/// equal_samples, an error below the resolution of the reference.
struct GainFigures {
    std::string length;         ///< "128", samples per pixel, or "0.7 s"
    Intervals base_errors{};    ///< of `default`
    Intervals equal_samples{};  ///< error of `default` over the error of the method
    Intervals equal_time{};     ///< the same when both have taken the time of `default` at this length
    Interval slowdown{};        ///< time of the method for the same samples, over the time of `default`
    Interval base_seconds{};    ///< time of `default` to this length
};

/// Error of a run at a time, on straight lines of its logarithm over the logarithm of time between checkpoints; after the last
/// one on a line of slope -1. NaN before the first one.
double error_at_time(const GainRun& run, std::size_t error, double seconds);

/// At the seconds of `length`, then at its samples. Runs of the same index have the same seed: means are of logarithms of
/// their ratios, intervals Student's.
std::vector<GainFigures> gain_figures(const std::vector<GainRun>& base, const std::vector<GainRun>& method,
                                      const RunLength& length);

}  // namespace pl::benchmarks
