// The schedule of updates: when pending training samples change the tables that guide later paths.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

namespace pl {

/// Most passes that train between two updates of a field with enough samples: their pending sums stay far from an overflow.
inline constexpr std::uint32_t kMostTrainingPasses = 16;

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

/// Passes from one update to the next: with light samples the largest power of two among the passes so far, so that there are updates
/// after 1, 2, 4, 8, 16, ... passes; without them half of it, and there are updates after 3, 6, 12, ... passes, too. Tables are never
/// far behind, and the sequences of first vertices, which begin anew with every update, are spread over many passes: most of all the
/// sequences of their light samples (docs/notebook/2026-11-30-fewer-updates.md). `passes`: complete passes since the film was last
/// cleared, so that tables adapt to a moved camera at once.
constexpr std::uint32_t update_interval(std::uint32_t passes, bool samples_lights) {
    return std::max(std::bit_floor(passes) / (samples_lights ? 1u : 2u), 1u);
}
/// Whether an update follows so many complete passes.
constexpr bool is_updated_after(std::uint32_t passes, bool samples_lights) {
    return passes % update_interval(passes, samples_lights) == 0;
}

/// Training samples per volume, on average, beyond which further samples gain little: 16 per cell of the default
/// (docs/notebook/2026-11-30-fewer-updates.md).
inline constexpr std::uint64_t kEnoughSamplesPerVolume = 4096;
/// One in so many passes trains a field that has enough samples: paths that make no training samples take an eighth less time.
inline constexpr std::uint32_t kTrainingInterval = 4;

/// Whether a pass trains the field; `pass` is its number since the film was last cleared. Passes that train a field with enough
/// samples are the last before an update, one after the other, so that a back end may render the passes before them at once.
constexpr bool is_trained_by(std::uint32_t pass, bool samples_lights, bool has_enough_samples) {
    const std::uint32_t interval = update_interval(pass, samples_lights);
    if (!has_enough_samples || interval < 2 * kTrainingInterval) return true;
    return pass % interval >= interval - std::min(interval / kTrainingInterval, kMostTrainingPasses);
}

}  // namespace pl
