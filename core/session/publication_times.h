// After which passes of a picture what they recorded becomes the tables of the next ones.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

namespace pl {

/// Most passes that go by without a publication: what sums of a cell can hold is no concern then.
inline constexpr std::uint32_t kMostPassesUnpublished = 16;

/// After each of the first sixteen passes, then whenever about an eighth has come to what was known: tables are never far behind, and
/// publishing, which costs the same for any number of records, does not grow with the passes of small pictures. `passes` are
/// complete ones since the picture was last emptied, so a camera that moves is followed at once. Records wait in their sums.
constexpr bool is_published_after(std::uint32_t passes) {
    const std::uint32_t interval = std::clamp(std::bit_floor(passes) / 8, 1u, kMostPassesUnpublished);
    return passes % interval == 0;
}

}  // namespace pl
