// Which rank renders which pixels of a film. The shares change the time of a pass, and no bit of it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/parallel.h"
#include "core/kernel/film/sample_variance.h"

namespace pl {

inline IndexRange common_part(IndexRange a, IndexRange b) {
    const std::uint32_t begin = a.begin > b.begin ? a.begin : b.begin;
    const std::uint32_t end = a.end < b.end ? a.end : b.end;
    return {begin, end > begin ? end : begin};
}

/// A film as blocks of pixels, each cut into one contiguous share per rank. A pass ends or is stopped between blocks, so the pixels
/// rendered are a prefix of the film whatever the number of ranks. No cut divides a block of pixels, see
/// VarianceMeasure::kBlock.
class Shares {
public:
    /// Pixels of a share, at most, unless a test asks for fewer: tenths of a second of work, after which a request to stop is honored.
    static constexpr std::uint32_t kMostPixels = 1u << 16;

    Shares() = default;
    explicit Shares(int ranks, std::uint32_t most_pixels = kMostPixels)
        : ranks_(static_cast<std::uint32_t>(ranks)), most_pixels_(most_pixels) {}

    /// Adds blocks until the film is shared out up to `end`. Blocks end there: the parts of a first pass, each of which waits for the
    /// one before, are shared out one by one.
    void cover(std::uint32_t end);

    std::size_t blocks() const { return cuts_.size() / (ranks_ + 1); }
    IndexRange block(std::size_t block) const { return {cut(block, 0), cut(block, ranks_)}; }
    IndexRange share(std::size_t block, int rank) const {
        return {cut(block, static_cast<std::uint32_t>(rank)), cut(block, static_cast<std::uint32_t>(rank) + 1)};
    }
    /// All pixels of a rank, in ascending order.
    std::vector<IndexRange> shares_of(int rank) const;

    /// New cuts of every block, by which shares that take time in proportion to the last ones take the same time. `seconds`:
    /// [block][rank]. Blocks that differ by less than a twentieth, or whose time is too short to tell, stay.
    Shares balanced(std::span<const double> seconds) const;

    friend bool operator==(const Shares&, const Shares&) = default;

private:
    std::uint32_t cut(std::size_t block, std::uint32_t i) const { return cuts_[block * (ranks_ + 1) + i]; }
    void balance_block(std::size_t block, std::span<const double> seconds);

    std::uint32_t ranks_ = 1;
    std::uint32_t most_pixels_ = kMostPixels;  ///< of a share
    std::vector<std::uint32_t> cuts_;          ///< [block][cut]
};

}  // namespace pl
