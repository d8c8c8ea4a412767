// The factor in time to the same error of a run over the baseline, with an interval from repetitions or from the blocks
// of the picture.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/measure/gain.h"
#include "ui/plot/run_lines.h"

namespace pl::ui {

/// The spread that a 95 % interval is made of.
enum class IntervalSource {
    None,
    Blocks,  ///< of the errors over blocks of one picture: runs of other seeds differ by more
    Seeds,   ///< of at least kFewestRuns repetitions of each side
};

struct RunGain {
    Interval
        net;  ///< time of the baseline over that of the run, to the same error; no bounds with IntervalSource::None
    IntervalSource source = IntervalSource::None;
    std::string sentence;  ///< the factors behind it, see headline()
};

/// Whether two runs differ at most in their seeds, and in how far they have come.
bool are_repetitions(const RunLabel& a, const RunLabel& b);

/// The newest run like this one for each seed, if it was measured for at least half as long as the longest of them: one
/// that has just begun would shorten all others.
std::vector<std::shared_ptr<const LiveRun>> repetitions_of(RunList runs, const LiveRun& like);

/// `run` and its repetitions against `base` and its own. By Metrics::relmse if both have it, else by their own noise,
/// which the sentence states. At the last time at which all were measured, else, or if a side has too few samples by then, at the end of
/// each. Repetitions that have too few samples at their ends do not count; empty if no other is left on a side.
std::optional<RunGain> gain_of_run(RunList runs, const LiveRun& base, const LiveRun& run);

}  // namespace pl::ui
