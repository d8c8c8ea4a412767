// Means over square blocks of pixels, with their standard errors.
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "core/measure/halves.h"

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

}  // namespace pl
