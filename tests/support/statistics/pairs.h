// Whether pairs of numbers are uniform and independent.
#pragma once

#include <array>

#include "tests/support/statistics/rules.h"

namespace pl::test {

/// Counts of pairs of numbers in [0, 1) in kSide x kSide bins.
class Pairs {
public:
    void add(float x, float y) {
        ++counts_[static_cast<std::size_t>(x * kSide) * kSide + static_cast<std::size_t>(y * kSide)];
    }
    /// Rule S3; resolves 5 % of the density.
    Decision are_uniform() const {
        std::uint64_t total = 0;
        for (const std::uint64_t count : counts_) total += count;
        std::array<double, kSide * kSide> expected{};
        expected.fill(static_cast<double>(total) / (kSide * kSide));
        return follows_density(counts_, expected, 0.05);
    }

private:
    static constexpr std::uint32_t kSide = 16;
    std::array<std::uint64_t, kSide * kSide> counts_{};
};

}  // namespace pl::test
