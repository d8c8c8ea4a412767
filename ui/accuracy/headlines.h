// The sentence that says what a method gains or loses against default, for every method tried on the present picture.
#pragma once

#include <string>
#include <vector>

#include "ui/accuracy/run_lines.h"

namespace pl {

struct Headline {
    std::uint64_t run = 0;
    std::uint32_t color = 0;  ///< of the method, opaque ARGB
    std::string text;
};

/// One for each method and back end other than default: of its newest run of this picture, against base_of() it. By
/// Metrics::relmse where both runs have it, else by their own noise, which is said. One run each has no interval, which
/// is said too. At the last time at which both were measured, else at the end of each. Never empty: without anything to compare it tells what to do.
std::vector<Headline> make_headlines(RunList runs, std::uint64_t picture);

}  // namespace pl
