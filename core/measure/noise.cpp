#include "core/measure/noise.h"

#include <algorithm>

#include "core/measure/block_means.h"
#include "core/measure/chunks.h"

namespace pl {
namespace {

/// Sums over the windows around the pixels of one row after the other, without pixels that are not finite.
class WindowSums {
public:
    WindowSums(const PictureHalves& halves, std::uint32_t width, std::uint32_t height)
        : halves_(halves), shares_(halves), width_(width), height_(height), columns_(width, glm::dvec4(0.0)) {}

    /// Before the first pixel of a row; rows in ascending order.
    void enter_row(std::uint32_t row) {
        const std::uint32_t end = std::min(row + kReach + 1, height_);
        if (last_row_ == kNone)
            for (std::uint32_t y = row < kReach ? 0 : row - kReach; y < end; ++y) add_row(y, 1.0);
        else {
            if (row + kReach < height_) add_row(row + kReach, 1.0);
            if (row > kReach) add_row(row - kReach - 1, -1.0);
        }
        last_row_ = row;
        window_ = glm::dvec4(0.0);
        for (std::uint32_t x = 0; x < std::min(kReach, width_); ++x) window_ += columns_[x];
    }

    /// Mean around a pixel; columns one after the other.
    Vec3d mean_at(std::uint32_t column) {
        if (column + kReach < width_) window_ += columns_[column + kReach];
        if (column > kReach) window_ -= columns_[column - kReach - 1];
        return Vec3d{window_} / std::max(window_.w, 1.0);
    }

private:
    static constexpr std::uint32_t kReach = kNoiseWindow;
    static constexpr std::uint32_t kNone = 0xffffffffu;

    void add_row(std::uint32_t row, double sign) {
        for (std::uint32_t x = 0; x < width_; ++x) {
            const std::size_t i = std::size_t{row} * width_ + x;
            if (!is_finite(halves_.first[i]) || !is_finite(halves_.second[i])) continue;
            columns_[x] += sign * glm::dvec4(shares_.mean(Vec3d{halves_.first[i]}, Vec3d{halves_.second[i]}), 1.0);
        }
    }

    const PictureHalves& halves_;
    HalfShares shares_;
    std::uint32_t width_;
    std::uint32_t height_;
    std::vector<glm::dvec4> columns_;  ///< sums over the rows of the window, and their number
    glm::dvec4 window_{0.0};
    std::uint32_t last_row_ = kNone;
};

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
        WindowSums around(halves, columns, rows);
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
