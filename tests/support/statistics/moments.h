// Mean and variance of a stream of numbers.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

namespace pl::test {

/// Running mean and sum of squared deviations.   [Welford 1962]
class Moments {
public:
    void add(double x) {
        ++count_;
        const double before = x - mean_;
        mean_ += before / static_cast<double>(count_);
        squares_ += before * (x - mean_);
    }

    std::uint64_t count() const { return count_; }
    double mean() const { return mean_; }
    /// Unbiased; infinite below two samples, so that one sample decides nothing.
    double variance() const {
        return count_ < 2 ? std::numeric_limits<double>::infinity() : squares_ / static_cast<double>(count_ - 1);
    }
    /// Of the mean.
    double standard_error() const { return std::sqrt(variance() / static_cast<double>(count_)); }

private:
    std::uint64_t count_ = 0;
    double mean_ = 0.0;
    double squares_ = 0.0;
};

}  // namespace pl::test
