#include "core/measure/halves.h"

#include <cmath>
#include <string>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/measure/block_means.h"

namespace pl {
namespace {

/// Sums over pixels on the way to ErrorParts.
struct PartSums {
    double error = 0.0;
    double variance = 0.0;
    double reference_noise = 0.0;
    double reference_luminance = 0.0;
    std::size_t pixels = 0;
    std::size_t invalid = 0;

    void add(const PartSums& other) {
        error += other.error;
        variance += other.variance;
        reference_noise += other.reference_noise;
        reference_luminance += other.reference_luminance;
        pixels += other.pixels;
        invalid += other.invalid;
    }
};

/// Adds the pixels of one row of blocks after the other.
class PartsTaker {
public:
    PartsTaker(const PictureHalves& picture, const PictureHalves& reference, std::size_t width)
        : picture_(picture), reference_(reference), shares_(picture), width_(width),
          columns_((width + kBlockSide - 1) / kBlockSide), rows_(picture.first.size() / width),
          error_(columns_ * ((rows_ + kBlockSide - 1) / kBlockSide)), squared_bias_(error_), difference_(error_) {}

    ErrorParts take(int threads) {
        PartSums total;
        for (const PartSums& sums : sums_of_chunks(rows_, kBlockSide, threads, PartSums{},
                                                   [this](PartSums&sums, IndexRange rows) { add_rows(sums, rows); }))
            total.add(sums);
        ErrorParts parts;
        parts.pixels = total.pixels;
        parts.invalid = total.invalid;
        if (total.pixels == 0) return parts;
        const auto n = static_cast<double>(total.pixels);
        parts.error = total.error / n;
        parts.error_off = error_.finish().error;
        parts.variance = total.variance / n;
        parts.reference_noise = total.reference_noise / n;
        parts.squared_bias = squared_bias_.finish();
        parts.signed_bias = difference_.finish();
        const double scale = total.reference_luminance == 0.0 ? 0.0 : n / total.reference_luminance;
        parts.signed_bias.value *= scale;
        parts.signed_bias.error *= std::fabs(scale);
        return parts;
    }

private:
    void add_rows(PartSums& sums, IndexRange rows) {
        for (std::size_t row = rows.begin; row < rows.end; ++row)
            for (std::size_t column = 0; column < width_; ++column)
                add_pixel(sums, row * width_ + column, row / kBlockSide * columns_ + column / kBlockSide);
    }

    void add_pixel(PartSums& sums, std::size_t i, std::size_t block) {
        if (!is_finite(picture_.first[i]) || !is_finite(picture_.second[i]) || !is_finite(reference_.first[i]) ||
            !is_finite(reference_.second[i])) {
            ++sums.invalid;
            return;
        }
        const Vec3d a{picture_.first[i]}, b{picture_.second[i]};
        const Vec3d r1{reference_.first[i]}, r2{reference_.second[i]};
        const Vec3d x = shares_.mean(a, b), r = 0.5 * (r1 + r2);
        const Vec3d weight = relative_weight(r);
        const double error = channel_mean(weight * (x - r1) * (x - r2));
        sums.error += error;
        error_.add(block, error);
        sums.variance += channel_mean(weight * shares_.variance(a, b));
        sums.reference_noise += channel_mean(weight * 0.25 * (r1 - r2) * (r1 - r2));
        sums.reference_luminance += luminance_of(r);
        squared_bias_.add(block, channel_mean(weight * (a - r1) * (b - r2)));
        difference_.add(block, luminance_of(x - r));
        ++sums.pixels;
    }

    const PictureHalves& picture_;
    const PictureHalves& reference_;
    HalfShares shares_;
    std::size_t width_;
    std::size_t columns_;
    std::size_t rows_;
    BlockMeans error_;
    BlockMeans squared_bias_;
    BlockMeans difference_;
};

}  // namespace

void require_same_sizes(std::initializer_list<Pixels> pictures) {
    for (const Pixels& picture : pictures)
        if (picture.size() != pictures.begin()->size())
            throw Error(ErrorKind::Input, "expected halves of the same size, got " +
                                              std::to_string(pictures.begin()->size()) + " and " +
                                              std::to_string(picture.size()) + " pixels");
}

void require_full_rows(std::size_t pixels, int width) {
    if (width < 1 || pixels % static_cast<std::size_t>(width) != 0)
        throw Error(ErrorKind::Input, "expected full rows of pixels, got " + std::to_string(pixels) +
                                          " pixels in rows of " + std::to_string(width));
}

bool Estimate::is_seen() const { return std::fabs(value) > 2.0 * error; }

PictureHalves halves_of(const FilmHalves& halves) {
    return {.first = halves.mean[0],
            .second = halves.mean[1],
            .first_weight = static_cast<double>(halves.weights[0]),
            .second_weight = static_cast<double>(halves.weights[1])};
}

ErrorParts take_apart(const PictureHalves& picture, const PictureHalves& reference, int width, int threads) {
    require_same_sizes({picture.first, picture.second, reference.first, reference.second});
    require_full_rows(picture.first.size(), width);
    return PartsTaker(picture, reference, static_cast<std::size_t>(width)).take(threads);
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
