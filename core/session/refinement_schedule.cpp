#include "core/session/refinement_schedule.h"

#include <algorithm>
#include <limits>

namespace pl {
namespace {

/// Rounds that add the share of the settings, each a part of it. If the settings leave the share open, more rounds
/// follow with the training samples: fewer than would overflow passes_before_round().
constexpr std::uint32_t kRounds = 2;
constexpr std::uint32_t kMostRounds = 32;

std::uint32_t most_rounds(const FieldSettings& settings) {
    if (settings.refine_share == 0.0f) return 0;
    if (!has_tables(settings.representation)) return 0;  // refined by their updates
    return settings.refine_share == kRefineByRecords ? kMostRounds : kRounds;
}

/// Passes of training samples before a round: 8, 16, 48, 96, 192 and so on. Tables need samples before their
/// disagreement exceeds noise, and new volumes need passes to learn from. The later rounds avoid powers of two,
/// common numbers of passes: a round at the end of a picture has a cost and no benefit. The schedules that were
/// compared are in docs/notebook/2026-11-22-refinement.md.
constexpr std::uint64_t passes_before_round(std::uint32_t round) {
    return round < kRounds ? std::uint64_t{8} << round : std::uint64_t{12} << round;
}

/// Mean number of training samples per cell before volumes are added if the settings leave the share open: with fewer
/// samples, or in pictures too short to gain from refinement, a coarser placement has less error. Late divisions need
/// more samples.
constexpr std::uint64_t kSamplesPerCell = 32;
constexpr std::uint64_t kSamplesPerCellLate = 96;

/// Number of volumes that the training samples suffice for in a round.
std::size_t most_by_samples(const FieldSettings& settings, std::uint32_t round, std::uint64_t samples) {
    if (settings.refine_share != kRefineByRecords) return std::numeric_limits<std::size_t>::max();
    const std::uint64_t needed = round < kRounds ? kSamplesPerCell : kSamplesPerCellLate;
    return samples / (needed * static_cast<std::uint64_t>(settings.bins));
}

}  // namespace

std::optional<std::size_t> volumes_to_add(const FieldSettings& settings, std::size_t volumes,
                                          const Refinement& so_far, const FieldProgress& progress,
                                          std::size_t light_clusters) {
    if (so_far.rounds >= most_rounds(settings)) return std::nullopt;
    if (progress.passes < passes_before_round(so_far.rounds)) return std::nullopt;
    const std::size_t placed = volumes - so_far.added;
    const std::size_t most = most_refined_volumes(settings, placed, light_clusters) - placed;
    const std::size_t parts = std::min(so_far.rounds + 1, kRounds);
    const std::size_t due =
        std::min(placed + most * parts / kRounds, most_by_samples(settings, so_far.rounds, progress.records));
    return due > volumes ? due - volumes : 0;
}

}  // namespace pl
