#include "core/measure/metrics.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/base/error.h"

namespace pl {
namespace {

void require_same_size(Pixels picture, Pixels reference) {
    if (picture.size() != reference.size())
        throw Error(ErrorKind::Input, "expected a picture of " + std::to_string(reference.size()) +
                                          " pixels as the reference has, got " + std::to_string(picture.size()));
}

/// Mean of all but the `share` largest values; reorders them.
double trimmed_mean(std::vector<double>& values, double share) {
    if (values.empty()) return 0.0;
    const auto kept = static_cast<std::ptrdiff_t>(std::ceil((1.0 - share) * static_cast<double>(values.size())));
    if (kept < static_cast<std::ptrdiff_t>(values.size()))
        std::nth_element(values.begin(), values.begin() + kept, values.end());
    double sum = 0.0;
    for (std::ptrdiff_t i = 0; i < kept; ++i) sum += values[static_cast<std::size_t>(i)];
    return sum / static_cast<double>(kept);
}

/// Sums over pixels on the way to Metrics.
class ErrorSums {
public:
    explicit ErrorSums(std::size_t pixels) {
        squares_.reserve(pixels);
        relative_squares_.reserve(pixels);
    }

    /// `square` is (x-r)^2 by channel, or what stands for it.
    void add(const Vec3d& x, const Vec3d& r, const Vec3d& square) {
        double plain = 0.0;
        double relative = 0.0;
        for (int c = 0; c < 3; ++c) {
            const double distance = std::fabs(x[c] - r[c]);
            plain += square[c];
            relative += square[c] / (r[c] * r[c] + kEpsilon);
            absolute_ += distance / (std::fabs(r[c]) + kEpsilon);
            symmetric_ += 2.0 * distance / (std::fabs(x[c]) + std::fabs(r[c]) + kEpsilon);
        }
        squares_.push_back(plain / 3.0);
        relative_squares_.push_back(relative / 3.0);
        difference_ += luminance_of(x - r);
        reference_ += luminance_of(r);
    }

    Metrics finish(std::size_t invalid, std::size_t invalid_reference) {
        Metrics m{.pixels = squares_.size(), .invalid = invalid, .invalid_reference = invalid_reference};
        if (m.pixels == 0) return m;
        const auto n = static_cast<double>(m.pixels);
        m.mse = trimmed_mean(squares_, 0.0);
        m.relmse = trimmed_mean(relative_squares_, 0.0);
        m.mse_trimmed = trimmed_mean(squares_, kTrimmedShare);
        m.relmse_trimmed = trimmed_mean(relative_squares_, kTrimmedShare);
        m.rmse = std::sqrt(std::max(m.mse, 0.0));
        m.mape = absolute_ / (3.0 * n);
        m.smape = symmetric_ / (3.0 * n);
        m.bias = difference_ / n;
        m.relative_bias = reference_ == 0.0 ? 0.0 : difference_ / reference_;
        m.psnr_db = -10.0 * std::log10(std::max(m.mse, 0.0));
        return m;
    }

private:
    std::vector<double> squares_;
    std::vector<double> relative_squares_;
    double absolute_ = 0.0;
    double symmetric_ = 0.0;
    double difference_ = 0.0;
    double reference_ = 0.0;
};

}  // namespace

bool is_finite(const Vec3f& pixel) {
    return std::isfinite(pixel.x) && std::isfinite(pixel.y) && std::isfinite(pixel.z);
}

double luminance_of(const Vec3d& radiance) { return 0.2126 * radiance.x + 0.7152 * radiance.y + 0.0722 * radiance.z; }

std::size_t count_invalid(Pixels picture) {
    return static_cast<std::size_t>(
        std::count_if(picture.begin(), picture.end(), [](const Vec3f& pixel) { return !is_finite(pixel); }));
}

std::size_t first_invalid(Pixels picture) {
    return static_cast<std::size_t>(
        std::find_if(picture.begin(), picture.end(), [](const Vec3f& pixel) { return !is_finite(pixel); }) -
        picture.begin());
}

Metrics measure_error(Pixels picture, Pixels reference) { return measure_error(picture, {reference, reference}); }

Metrics measure_error(Pixels picture, const ReferenceHalves& reference) {
    require_same_size(picture, reference.first);
    require_same_size(picture, reference.second);
    ErrorSums sums(picture.size());
    std::size_t invalid = 0;
    std::size_t invalid_reference = 0;
    for (std::size_t i = 0; i < picture.size(); ++i) {
        if (!is_finite(picture[i])) {
            ++invalid;
            continue;
        }
        if (!is_finite(reference.first[i]) || !is_finite(reference.second[i])) {
            ++invalid_reference;
            continue;
        }
        const Vec3d x{picture[i]};
        const Vec3d r1{reference.first[i]};
        const Vec3d r2{reference.second[i]};
        sums.add(x, 0.5 * (r1 + r2), (x - r1) * (x - r2));
    }
    return sums.finish(invalid, invalid_reference);
}

}  // namespace pl
