// Accumulation: sums in double, so that ten million samples lose nothing a float could show.
#pragma once

#include "core/kernel/base/math.h"
#include "core/kernel/base/span.h"

namespace pl {

struct FilmPixel {
    Vec3d sum{0.0};  ///< of valid samples, linear sRGB radiance
    double sum_squared_luminance = 0.0;
    std::uint32_t samples = 0;  ///< valid ones: what the mean divides by
    std::uint32_t invalid = 0;  ///< NaN, infinite or negative ones: dropped, counted, shown
};

struct FilmView {
    Span<FilmPixel> pixels;  ///< [row][column], row 0 at the top
    std::uint32_t width = 0;
    std::uint32_t height = 0;
};

/// Adds one sample; every pixel has one writer at a time. Returns false if the sample was invalid.
PL_HD inline bool accumulate(const FilmView& film, std::uint32_t pixel, Vec3f radiance) {
    FilmPixel& p = film.pixels[pixel];
    if (!is_valid_radiance(radiance)) {
        ++p.invalid;
        return false;
    }
    const Vec3d value{radiance};
    const double y = 0.2126 * value.x + 0.7152 * value.y + 0.0722 * value.z;
    p.sum += value;
    p.sum_squared_luminance += y * y;
    ++p.samples;
    return true;
}

/// Makes one sample all that a pixel holds. Returns false if the sample was invalid.
PL_HD inline bool replace_sample(const FilmView& film, std::uint32_t pixel, Vec3f value) {
    film.pixels[pixel] = {};
    return accumulate(film, pixel, value);
}

/// Mean radiance of a pixel; 0 before the first sample.
PL_HD inline Vec3f mean_radiance(const FilmPixel& pixel) {
    if (pixel.samples == 0) return Vec3f{0.0f};
    return Vec3f{pixel.sum * (1.0 / static_cast<double>(pixel.samples))};
}

/// The same, but NaN where every sample was invalid, so that it shows.
PL_HD inline Vec3f mean_or_nan(const FilmPixel& pixel) {
    const bool all_invalid = pixel.samples == 0 && pixel.invalid > 0;
    return all_invalid ? Vec3f{kNan} : mean_radiance(pixel);
}

}  // namespace pl
