// Means over square blocks of pixels, with their standard errors.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/measure/halves.h"
#include "core/measure/noise.h"

namespace pl {

/// Sums over blocks of kBlockSide x kBlockSide pixels, for the mean over all pixels and its standard error. Threads
/// may add to different blocks.
class BlockMeans {
public:
    explicit BlockMeans(std::size_t blocks) : sums_(blocks, 0.0), counts_(blocks, 0.0) {}

    void add(std::size_t block, double value) {
        sums_[block] += value;
        counts_[block] += 1.0;
    }

    /// Ratio of sums, so that smaller blocks at the border count less; error by linearization.   [Cochran 1977, 6.3]
    Estimate finish() const {
        double sum = 0.0;
        double count = 0.0;
        double blocks = 0.0;
        for (std::size_t i = 0; i < sums_.size(); ++i) {
            sum += sums_[i];
            count += counts_[i];
            blocks += counts_[i] > 0.0 ? 1.0 : 0.0;
        }
        if (count == 0.0) return {0.0, std::numeric_limits<double>::infinity()};
        const double mean = sum / count;
        if (blocks < 2.0) return {mean, std::numeric_limits<double>::infinity()};
        double squares = 0.0;
        for (std::size_t i = 0; i < sums_.size(); ++i) {
            const double residual = sums_[i] - mean * counts_[i];
            squares += residual * residual;
        }
        return {mean, std::sqrt(squares * blocks / (blocks - 1.0)) / count};
    }

private:
    std::vector<double> sums_;
    std::vector<double> counts_;
};

// Means of a picture over the windows around its pixels: an estimate of their converged values.

/// Goes over the pixels row by row. Pixels that are not finite in a half count for nothing.
class WindowMeans {
public:
    /// `halves` outlives it.
    WindowMeans(const PictureHalves& halves, std::uint32_t width, std::uint32_t height)
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

}  // namespace pl
