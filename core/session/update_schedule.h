// When what the passes of a picture recorded becomes the tables that later paths are guided by.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

namespace pl {

/// Most passes that go by without a publication: what sums of a cell can hold is no concern then.
inline constexpr std::uint32_t kMostPassesWithoutUpdate = 16;

/// Fewest paths that are worth a publication.
inline constexpr std::uint32_t kFewestPathsBeforeUpdate = 1024;

/// The first pass that is learned from is the dearest: nothing is known yet. It publishes on its way, after as many paths as
/// there are volumes and whenever they have doubled, so that at least half of it is guided. Returns where a part of the pass
/// ends that is under way after `done` of its `count` paths.
constexpr std::uint32_t end_of_first_part(std::uint32_t done, std::uint32_t count, std::uint32_t volumes) {
    std::uint64_t end = std::bit_ceil(std::uint64_t{std::max(volumes, kFewestPathsBeforeUpdate)});
    while (end <= done) end *= 2;
    return static_cast<std::uint32_t>(std::min(end, std::uint64_t{count}));
}

/// After each of the first sixteen passes, then whenever about an eighth has come to what was known: tables are never far behind, and
/// publishing, which costs the same for any number of records, does not grow with the passes of small pictures. `passes` are
/// complete ones since the picture was last emptied, so a camera that moves is followed at once. Records wait in their sums.
constexpr bool is_updated_after(std::uint32_t passes) {
    const std::uint32_t interval = std::clamp(std::bit_floor(passes) / 8, 1u, kMostPassesWithoutUpdate);
    return passes % interval == 0;
}

}  // namespace pl
