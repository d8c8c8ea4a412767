// The runs of the picture in the window as the rows of a table.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/measure/gain.h"
#include "ui/plot/run_lines.h"

namespace pl::ui {

// The factor in time to the same error of a run over the baseline, with an interval from repetitions or from the blocks
// of the picture.

/// The spread that a 95 % interval is made of.
enum class IntervalSource {
    None,
    Blocks,  ///< of the errors over blocks of one picture: runs of other seeds differ by more
    Seeds,   ///< of at least kFewestRuns repetitions of each side
};

struct RunGain {
    Interval
        net;  ///< time of the baseline over the time of the run, to the same error; no bounds with IntervalSource::None
    IntervalSource source = IntervalSource::None;
    std::string sentence;  ///< the factors behind it, see headline()
};

/// Whether two runs differ at most in their seeds, and in how far they have come.
bool are_repetitions(const RunLabel& a, const RunLabel& b);

/// The newest run like this one for each seed that was measured with some samples and for at least half as long as the longest of
/// them: one that has just begun would shorten all others.
std::vector<std::shared_ptr<const LiveRun>> repetitions_of(RunList runs, const LiveRun& like);

/// `run` and its repetitions against `base` and its own. By Metrics::relmse if both have it, else by their own noise,
/// which the sentence states. At the last time at which all were measured, else, or if a side has too few samples by then, at the end of
/// each. Repetitions that have too few samples at their ends do not count; empty if no other is left on a side.
std::optional<RunGain> gain_of_run(RunList runs, const LiveRun& base, const LiveRun& run);

/// The reason why a run has no gain.
enum class MissingGain { None, IsBase, TooFewSamples, NoBase };

struct RunRow {
    std::uint64_t run = 0;   ///< the newest of its repetitions
    std::uint64_t base = 0;  ///< the run that it is compared with; 0 for none
    RunLabel label;
    bool is_base = false;             ///< the others are compared with it
    std::size_t seeds = 1;            ///< runs that differ in the seed alone, this one included
    double samples = 0.0;             ///< per pixel
    double seconds_per_sample = 0.0;  ///< charged, set-up included; 0 before the first point
    std::optional<RunGain> gain;
    MissingGain missing = MissingGain::None;
    std::string remark;  ///< a sentence for tooltips: the factors behind the gain, or the reason why there is none
};

struct RunTable {
    static constexpr std::size_t kMostRows = 6;

    RunBase base{};
    std::vector<RunRow> rows;          ///< the newest kinds of runs, in the order of their first points
    std::vector<std::uint64_t> older;  ///< numbers of other runs of the picture, which a newer run or row replaces
    std::string note;  ///< the next step for a user who has nothing to compare; empty if there is a gain
};

/// One row for each method, back end, use of light samples, start and further settings. Each is compared with
/// base_of() it; a run that has just begun replaces no older one.
RunTable make_run_table(RunList runs, std::uint64_t picture, const RunBase& base = {}, bool in_turns = false);

/// Two runs in turns of equal time in words, as the table has measured them.
struct TurnsHeadline {
    std::string text;             ///< one sentence
    std::string detail;           ///< the number behind it with its interval; empty as long as nothing is measured
    const RunRow* row = nullptr;  ///< of the table: whose number it is
};
/// `halves`: the left and the right run. They have the base of the table. `late`: the half that works alone until both have had the same
/// time.
TurnsHeadline turns_headline(const RunTable& table, const std::array<RunLabel, 2>& halves,
                             std::optional<std::size_t> late = std::nullopt);

/// The newest row of the method that learns, with or without light samples, if it has a gain with an interval and began with nothing
/// learned; else null.
const RunRow* learning_row(const RunTable& table, bool next_event);
/// "4.5 times ahead", "1.3 times behind", "neither ahead nor behind": by such a row.
std::string ahead_text(const RunRow& row);

/// "1.7x", "0.58x", "no difference", "undecided", "1.7x, no interval", "baseline", "too short", "no baseline".
std::string gain_text(const RunRow& row);
/// "1.5-1.9": the 95 % interval of the factor; empty without one.
std::string interval_text(const RunRow& row);

}  // namespace pl::ui
