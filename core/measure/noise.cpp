#include "core/measure/noise.h"

#include "core/base/parallel.h"
#include "core/measure/block_means.h"

namespace pl {
namespace {

/// Means over all pixels, from sums over ranges of them.
Noise mean_of(const std::vector<Noise>& ranges, const BlockMeans& blocks) {
    Noise noise;
    for (const Noise& sums : ranges) {
        noise.mse += sums.mse;
        noise.relmse += sums.relmse;
        noise.pixels += sums.pixels;
        noise.invalid += sums.invalid;
    }
    if (noise.pixels > 0) {
        noise.mse /= static_cast<double>(noise.pixels);
        noise.relmse /= static_cast<double>(noise.pixels);
        noise.relmse_off = blocks.finish().error;
    }
    return noise;
}

}  // namespace

Noise estimate_noise(const PictureHalves& halves, int width, int threads) {
    require_full_rows(halves.first.size(), width);
    require_same_sizes({halves.first, halves.second});
    const HalfShares shares(halves);
    const auto columns = static_cast<std::uint32_t>(width);
    const auto rows = static_cast<std::uint32_t>(halves.first.size() / columns);
    const std::uint32_t block_columns = (columns + kBlockSide - 1) / kBlockSide;
    BlockMeans blocks(std::size_t{block_columns} * ((rows + kBlockSide - 1) / kBlockSide));
    const auto add = [&](Noise& sums, IndexRange range) {
        WindowMeans around(halves, columns, rows);
        for (std::uint32_t row = range.begin; row < range.end; ++row) {
            around.enter_row(row);
            for (std::uint32_t column = 0; column < columns; ++column) {
                const Vec3d mean = around.mean_at(column);
                const std::size_t i = std::size_t{row} * columns + column;
                if (!is_finite(halves.first[i]) || !is_finite(halves.second[i])) {
                    ++sums.invalid;
                    continue;
                }
                const Vec3d square = shares.variance(Vec3d{halves.first[i]}, Vec3d{halves.second[i]});
                sums.mse += channel_mean(square);
                const double relative = channel_mean(square * relative_weight(mean));
                sums.relmse += relative;
                blocks.add(std::size_t{row / kBlockSide} * block_columns + column / kBlockSide, relative);
                ++sums.pixels;
            }
        }
    };
    constexpr std::uint32_t kRowChunk = 2 * kBlockSide;  // no block belongs to two threads
    return mean_of(sums_of_chunks(rows, kRowChunk, threads, Noise{}, add), blocks);
}

}  // namespace pl
