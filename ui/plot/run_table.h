// The runs of the picture in the window as the rows of a table.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ui/plot/run_gain.h"

namespace pl::ui {

/// The reason why a run has no gain.
enum class MissingGain { None, IsBase, TooFewSamples, NoBase };

struct RunRow {
    std::uint64_t run = 0;  ///< the newest of its repetitions
    RunLabel label;
    std::size_t seeds = 1;            ///< runs that differ in the seed alone, this one included
    double samples = 0.0;             ///< per pixel
    double seconds_per_sample = 0.0;  ///< charged, set-up included; 0 before the first point
    std::optional<RunGain> gain;
    MissingGain missing = MissingGain::None;
    std::string remark;  ///< a sentence for tooltips: the factors behind the gain, or the reason why there is none
};

struct RunTable {
    static constexpr std::size_t kMostRows = 6;

    std::vector<RunRow> rows;          ///< the newest kinds of runs, in the order of their first points
    std::vector<std::uint64_t> older;  ///< numbers of other runs of the picture, which a newer run or row replaces
    std::string note;  ///< the next step for a user who has nothing to compare; empty if there is a gain
};

/// One row for each method, back end, use of light samples, start and further settings. Each is compared with
/// base_of() it; a run that has just begun replaces no older one.
RunTable make_run_table(RunList runs, std::uint64_t picture);

/// "1.7x", "0.58x", "no difference", "undecided", "1.7x, no interval", "baseline", "too few samples", "no baseline".
std::string gain_text(const RunRow& row);
/// "1.5-1.9": the 95 % interval of the factor; empty without one.
std::string interval_text(const RunRow& row);

}  // namespace pl::ui
