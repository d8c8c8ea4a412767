#include "core/measure/halves.h"

#include <cmath>
#include <limits>
#include <string>

#include "core/base/error.h"

namespace pl {
namespace {

void require_same_sizes(std::initializer_list<Pixels> pictures) {
    for (const Pixels& picture : pictures)
        if (picture.size() != pictures.begin()->size())
            throw Error(ErrorKind::Input, "expected halves of the same size, got " +
                                              std::to_string(pictures.begin()->size()) + " and " +
                                              std::to_string(picture.size()) + " pixels");
}

double channel_mean(const Vec3d& v) { return (v.x + v.y + v.z) / 3.0; }

/// What makes a square relative, by channel.
Vec3d relative_weight(const Vec3d& scale) { return Vec3d(1.0) / (scale * scale + Vec3d(kEpsilon)); }

/// Means over square blocks of pixels, of which the error of their mean follows.
class BlockMeans {
public:
    BlockMeans(std::size_t pixels, int width)
        : width_(static_cast<std::size_t>(width)), columns_((width_ + kBlockSide - 1) / kBlockSide),
          sums_(columns_ * ((pixels / width_ + kBlockSide - 1) / kBlockSide), 0.0), counts_(sums_.size(), 0.0) {}

    void add(std::size_t pixel, double value) {
        const std::size_t block = pixel / width_ / kBlockSide * columns_ + pixel % width_ / kBlockSide;
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
    std::size_t width_;
    std::size_t columns_;
    std::vector<double> sums_;
    std::vector<double> counts_;
};

}  // namespace

bool Estimate::is_seen() const { return std::fabs(value) > 2.0 * error; }

Noise estimate_noise(const PictureHalves& halves) {
    require_same_sizes({halves.first, halves.second});
    Noise noise;
    for (std::size_t i = 0; i < halves.first.size(); ++i) {
        if (!is_finite(halves.first[i]) || !is_finite(halves.second[i])) {
            ++noise.invalid;
            continue;
        }
        const Vec3d a{halves.first[i]};
        const Vec3d b{halves.second[i]};
        const Vec3d square = 0.25 * (a - b) * (a - b);
        noise.mse += channel_mean(square);
        noise.relmse += channel_mean(square * relative_weight(0.5 * (a + b)));
        ++noise.pixels;
    }
    if (noise.pixels > 0) {
        noise.mse /= static_cast<double>(noise.pixels);
        noise.relmse /= static_cast<double>(noise.pixels);
    }
    return noise;
}

ErrorParts take_apart(const PictureHalves& picture, const ReferenceHalves& reference, int width) {
    require_same_sizes({picture.first, picture.second, reference.first, reference.second});
    const std::size_t pixels = picture.first.size();
    if (width < 1 || pixels % static_cast<std::size_t>(width) != 0)
        throw Error(ErrorKind::Input, "expected full rows of pixels, got " + std::to_string(pixels) +
                                          " pixels in rows of " + std::to_string(width));
    ErrorParts parts;
    BlockMeans squared_bias(pixels, width);
    BlockMeans difference(pixels, width);
    double reference_luminance = 0.0;
    for (std::size_t i = 0; i < pixels; ++i) {
        if (!is_finite(picture.first[i]) || !is_finite(picture.second[i]) || !is_finite(reference.first[i]) ||
            !is_finite(reference.second[i])) {
            ++parts.invalid;
            continue;
        }
        const Vec3d a{picture.first[i]}, b{picture.second[i]};
        const Vec3d r1{reference.first[i]}, r2{reference.second[i]};
        const Vec3d x = 0.5 * (a + b), r = 0.5 * (r1 + r2);
        const Vec3d weight = relative_weight(r);
        parts.error += channel_mean(weight * (x - r1) * (x - r2));
        parts.variance += channel_mean(weight * 0.25 * (a - b) * (a - b));
        parts.reference_noise += channel_mean(weight * 0.25 * (r1 - r2) * (r1 - r2));
        squared_bias.add(i, channel_mean(weight * (a - r1) * (b - r2)));
        difference.add(i, luminance_of(x - r));
        reference_luminance += luminance_of(r);
        ++parts.pixels;
    }
    if (parts.pixels == 0) return parts;
    const auto n = static_cast<double>(parts.pixels);
    for (double* sum : {&parts.error, &parts.variance, &parts.reference_noise}) *sum /= n;
    parts.squared_bias = squared_bias.finish();
    parts.signed_bias = difference.finish();
    const double scale = reference_luminance == 0.0 ? 0.0 : n / reference_luminance;
    parts.signed_bias.value *= scale;
    parts.signed_bias.error *= std::fabs(scale);
    return parts;
}

std::vector<Vec3f> weighted_mean(Pixels first, double first_weight, Pixels second, double second_weight) {
    require_same_sizes({first, second});
    std::vector<Vec3f> mean(first.size());
    const double scale = 1.0 / (first_weight + second_weight);
    for (std::size_t i = 0; i < first.size(); ++i)
        mean[i] = Vec3f{scale * (first_weight * Vec3d{first[i]} + second_weight * Vec3d{second[i]})};
    return mean;
}

}  // namespace pl
