// One sentence on the gain of each method over the baseline, for every method rendered in the present picture.
#pragma once

#include <string>
#include <vector>

#include "ui/plot/run_lines.h"

namespace pl {

struct Headline {
    std::uint64_t run = 0;
    std::uint32_t color = 0;  ///< of the method, opaque ARGB
    std::string text;
};

/// One for each method and back end other than the baseline: its newest run of this picture against base_of() it. By
/// Metrics::relmse if both runs have it, else by their own noise, which the text states. Single runs have no interval,
/// which it states too. At the last time at which both were measured, else at the end of each. Never empty: without runs
/// to compare it names the keys that render them.
std::vector<Headline> make_headlines(RunList runs, std::uint64_t picture);

}  // namespace pl
