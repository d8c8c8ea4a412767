// The schedule of updates: when pending training samples change the tables that guide later paths.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

namespace pl {

/// Most passes between two updates: the sums of a cell cannot overflow within them.
inline constexpr std::uint32_t kMostPassesWithoutUpdate = 16;

/// Fewest paths before an update.
inline constexpr std::uint32_t kFewestPathsBeforeUpdate = 1024;

/// The first pass of a learner begins without guiding. Tables are updated within it, after as many paths as there are volumes
/// and whenever their number has doubled, so that at least half of its paths are guided. Returns the end of the part of the
/// pass that is under way after `done` of its `count` paths.
constexpr std::uint32_t end_of_first_part(std::uint32_t done, std::uint32_t count, std::uint32_t volumes) {
    std::uint64_t end = std::bit_ceil(std::uint64_t{std::max(volumes, kFewestPathsBeforeUpdate)});
    while (end <= done) end *= 2;
    return static_cast<std::uint32_t>(std::min(end, std::uint64_t{count}));
}

/// Passes from one update to the next: 1 for each of the first sixteen passes, then about an eighth of the passes so far. Tables are
/// never far behind, and updates, whose cost does not depend on the number of training samples, stay rare in small
/// pictures. `passes` are complete ones since the film was last cleared, so that tables adapt to a moved camera at
/// once.
constexpr std::uint32_t update_interval(std::uint32_t passes) {
    return std::clamp(std::bit_floor(passes) / 8, 1u, kMostPassesWithoutUpdate);
}
/// Whether an update follows so many complete passes. Guiding is chosen anew only here, too, so that a back end may render all passes
/// up to here at once.
constexpr bool is_updated_after(std::uint32_t passes) { return passes % update_interval(passes) == 0; }

/// Training samples per volume, on the mean, from which on a field gains little by further ones: 64 per cell of the default
/// (docs/notebook/2026-11-25-rare-training.md).
inline constexpr std::uint64_t kEnoughSamplesPerVolume = 16384;
/// One in as many passes trains a field that has enough of them: paths that make none take an eighth less time.
inline constexpr std::uint32_t kTrainingInterval = 4;

/// Whether a pass trains the field; `pass` is its number since the film was last cleared. Passes that train a field with enough
/// samples are the last ones before an update, together, so that a back end may render those before them at once.
constexpr bool is_trained_by(std::uint32_t pass, bool has_enough_samples) {
    const std::uint32_t interval = std::max(update_interval(pass), kTrainingInterval);
    return !has_enough_samples || pass < kMostPassesWithoutUpdate ||
           pass % interval >= interval - interval / kTrainingInterval;
}

}  // namespace pl
