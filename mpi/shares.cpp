#include "mpi/shares.h"

#include <algorithm>
#include <numeric>

namespace pl {

namespace {

std::uint32_t between_blocks(std::uint32_t pixel) { return pixel - pixel % VarianceMeasure::kBlock; }

}  // namespace

void Shares::cover(std::uint32_t end) {
    std::uint32_t begin = cuts_.empty() ? 0 : cuts_.back();
    const std::uint64_t most = std::uint64_t{most_pixels_} * ranks_;
    while (begin < end) {
        // Equal blocks, rather than a short one at the end.
        const std::uint64_t left = (end - begin + most - 1) / most;
        const auto even = begin + static_cast<std::uint32_t>((end - begin + left - 1) / left);
        const std::uint32_t length = std::min(between_blocks(even + VarianceMeasure::kBlock - 1), end) - begin;
        // Rounded up, so that rank 0 has the first pixel of every block.
        const std::uint32_t last = begin + length;
        for (std::uint64_t i = 0; i <= ranks_; ++i) {
            const auto cut = begin + static_cast<std::uint32_t>((i * length + ranks_ - 1) / ranks_);
            cuts_.push_back(i == 0 ? begin : std::min(between_blocks(cut + VarianceMeasure::kBlock - 1), last));
        }
        begin = last;
    }
}

std::vector<IndexRange> Shares::shares_of(int rank) const {
    std::vector<IndexRange> ranges;
    for (std::size_t i = 0; i < blocks(); ++i)
        if (const IndexRange range = share(i, rank); !range.empty()) ranges.push_back(range);
    return ranges;
}

Shares Shares::balanced(std::span<const double> seconds) const {
    Shares next = *this;
    for (std::size_t i = 0; i < blocks(); ++i) next.balance_block(i, seconds.subspan(i * ranks_, ranks_));
    return next;
}

/// Time as a function of the pixel is linear within each share: the new cuts lie at equal steps of time.
void Shares::balance_block(std::size_t block, std::span<const double> seconds) {
    constexpr double kShortest = 2.0e-4;  // of the mean share
    constexpr double kEven = 1.05;        // longest share over the mean
    const double total = std::accumulate(seconds.begin(), seconds.end(), 0.0);
    const double step = total / ranks_;
    if (step < kShortest || *std::ranges::max_element(seconds) < kEven * step) return;
    std::uint32_t* const cuts = &cuts_[block * (ranks_ + 1)];
    const std::vector<std::uint32_t> old(cuts, cuts + ranks_ + 1);
    std::uint32_t share = 0;
    double before = 0.0;  // of the shares before
    for (std::uint32_t i = 1; i < ranks_; ++i) {
        while (share + 1 < ranks_ && before + seconds[share] < i * step) before += seconds[share++];
        const double part = seconds[share] > 0.0 ? (i * step - before) / seconds[share] : 0.0;
        const double at = old[share] + std::clamp(part, 0.0, 1.0) * (old[share + 1] - old[share]);
        const std::uint32_t least = std::min(old[0] + VarianceMeasure::kBlock, old[ranks_]);  // for rank 0
        cuts[i] =
            std::clamp(between_blocks(static_cast<std::uint32_t>(at)), std::max(cuts[i - 1], least), old[ranks_]);
    }
}

}  // namespace pl
