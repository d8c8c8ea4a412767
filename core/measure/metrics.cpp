#include "core/measure/metrics.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/base/parallel.h"

namespace pl {
namespace {

void require_same_size(Pixels picture, Pixels reference) {
    if (picture.size() != reference.size())
        throw Error(ErrorKind::Input, "expected a picture of " + std::to_string(reference.size()) +
                                          " pixels as the reference has, got " + std::to_string(picture.size()));
}

std::size_t trimmed_count(std::size_t pixels) {
    const auto kept = static_cast<std::size_t>(std::ceil((1.0 - kTrimmedShare) * static_cast<double>(pixels)));
    return pixels - kept;
}

/// A sum that keeps its largest terms apart, so that one of them, however large, costs the others no digit.
class TrimmedSum {
public:
    explicit TrimmedSum(std::size_t most_left_out) : most_left_out_(most_left_out) {
        largest_.reserve(most_left_out + 1);
    }

    void add(double term) {
        if (largest_.size() == most_left_out_ && (largest_.empty() || term <= largest_.front())) {
            rest_ += term;
            return;
        }
        largest_.push_back(term);
        std::push_heap(largest_.begin(), largest_.end(), std::greater<>());
        if (largest_.size() <= most_left_out_) return;
        std::pop_heap(largest_.begin(), largest_.end(), std::greater<>());
        rest_ += largest_.back();
        largest_.pop_back();
    }

    /// Adds the terms of another sum.
    void add(const TrimmedSum& other) {
        rest_ += other.rest_;
        for (const double term : other.largest_) add(term);
    }

    /// Without the `left_out` largest terms, at most as many as are kept apart.
    double sum(std::size_t left_out) const {
        std::vector<double> descending = largest_;
        std::sort(descending.begin(), descending.end(), std::greater<>());
        return std::accumulate(descending.rbegin(), descending.rend() - static_cast<std::ptrdiff_t>(left_out), rest_);
    }

private:
    std::size_t most_left_out_;
    std::vector<double> largest_;  ///< a heap with the smallest in front
    double rest_ = 0.0;
};

/// Sums over pixels on the way to Metrics.
class ErrorSums {
public:
    explicit ErrorSums(std::size_t pixels)
        : squares_(trimmed_count(pixels)), relative_squares_(trimmed_count(pixels)) {}

    /// `square` is (x-r)^2 by channel, or its unbiased estimate.
    void add(const Vec3d& x, const Vec3d& r, const Vec3d& square) {
        double plain = 0.0;
        double relative = 0.0;
        for (int c = 0; c < 3; ++c) {
            const double distance = std::fabs(x[c] - r[c]);
            plain += square[c];
            // One division instead of three: the product of three floats is far from the limits of a double.
            const double of_square = r[c] * r[c] + kEpsilon;
            const double of_value = std::fabs(r[c]) + kEpsilon;
            const double of_both = std::fabs(x[c]) + of_value;
            const double inverse = 1.0 / (of_square * of_value * of_both);
            relative += square[c] * (inverse * (of_value * of_both));
            absolute_ += distance * (inverse * (of_square * of_both));
            symmetric_ += 2.0 * distance * (inverse * (of_square * of_value));
        }
        squares_.add(plain / 3.0);
        relative_squares_.add(relative / 3.0);
        ++pixels_;
        difference_ += luminance_of(x - r);
        reference_ += luminance_of(r);
    }

    void add(const ErrorSums& other) {
        squares_.add(other.squares_);
        relative_squares_.add(other.relative_squares_);
        pixels_ += other.pixels_;
        invalid += other.invalid;
        invalid_reference += other.invalid_reference;
        absolute_ += other.absolute_;
        symmetric_ += other.symmetric_;
        difference_ += other.difference_;
        reference_ += other.reference_;
    }

    Metrics finish() const {
        Metrics m{.pixels = pixels_, .invalid = invalid, .invalid_reference = invalid_reference};
        if (m.pixels == 0) return m;
        const auto n = static_cast<double>(m.pixels);
        const std::size_t left_out = trimmed_count(m.pixels);
        m.mse = squares_.sum(0) / n;
        m.relmse = relative_squares_.sum(0) / n;
        m.mse_trimmed = squares_.sum(left_out) / static_cast<double>(m.pixels - left_out);
        m.relmse_trimmed = relative_squares_.sum(left_out) / static_cast<double>(m.pixels - left_out);
        m.rmse = std::sqrt(std::max(m.mse, 0.0));
        m.mape = absolute_ / (3.0 * n);
        m.smape = symmetric_ / (3.0 * n);
        m.bias = difference_ / n;
        m.relative_bias = reference_ == 0.0 ? 0.0 : difference_ / reference_;
        m.psnr_db = -10.0 * std::log10(std::max(m.mse, 0.0));
        return m;
    }

    std::size_t invalid = 0;            ///< pixels that are not finite: not added
    std::size_t invalid_reference = 0;  ///< in the reference alone

private:
    TrimmedSum squares_;
    TrimmedSum relative_squares_;
    std::size_t pixels_ = 0;
    double absolute_ = 0.0;
    double symmetric_ = 0.0;
    double difference_ = 0.0;
    double reference_ = 0.0;
};

}  // namespace

std::size_t count_invalid(Pixels picture) {
    return static_cast<std::size_t>(
        std::count_if(picture.begin(), picture.end(), [](const Vec3f& pixel) { return !is_finite(pixel); }));
}

std::size_t first_invalid(Pixels picture) {
    return static_cast<std::size_t>(
        std::find_if(picture.begin(), picture.end(), [](const Vec3f& pixel) { return !is_finite(pixel); }) -
        picture.begin());
}

Metrics measure_error(Pixels picture, Pixels reference, int threads) {
    return measure_error(picture, {reference, reference}, threads);
}

Metrics measure_error(Pixels picture, const PictureHalves& reference, int threads) {
    require_same_size(picture, reference.first);
    require_same_size(picture, reference.second);
    const auto add = [&](ErrorSums& sums, IndexRange range) {
        for (std::size_t i = range.begin; i < range.end; ++i) {
            if (!is_finite(picture[i])) {
                ++sums.invalid;
                continue;
            }
            if (!is_finite(reference.first[i]) || !is_finite(reference.second[i])) {
                ++sums.invalid_reference;
                continue;
            }
            const Vec3d x{picture[i]};
            const Vec3d r1{reference.first[i]};
            const Vec3d r2{reference.second[i]};
            sums.add(x, 0.5 * (r1 + r2), (x - r1) * (x - r2));
        }
    };
    constexpr std::uint32_t kPixelChunk = 1u << 15;
    ErrorSums total(picture.size());
    for (const ErrorSums& sums : sums_of_chunks(picture.size(), kPixelChunk, threads, ErrorSums(picture.size()), add))
        total.add(sums);
    return total.finish();
}

}  // namespace pl
