// The film: per-pixel sums of radiance, in double so that the mean of ten million samples is exact to a float.
#pragma once

#include "core/kernel/base/math.h"
#include "core/kernel/base/span.h"

namespace pl {

/// Even and odd passes form the two halves of a film: independent estimates whose difference measures the noise.
PL_HD inline bool in_second_half(std::uint32_t pass) { return (pass & 1u) != 0; }

/// The emission that a pixel has seen last, and whether it varies within the pixel. Three objects: neighbors read the value
/// while the pixel's own thread sets the flags.
struct EmissionSeen {
    std::uint16_t value = 0;     ///< 0: nothing; kSky; else the upper half of a float (luminance), plus 1
    std::uint8_t varies = 0;     ///< 0 or the kind of the border, below
    std::uint8_t at_border = 0;  ///< 1: a neighbor has seen another emission

    static constexpr std::uint8_t kLampBorder = 1;    ///< further camera rays are traced
    static constexpr std::uint8_t kBorderMarked = 2;  ///< of a lamp: they will be
    static constexpr std::uint8_t kSkyBorder = 3;     ///< some are traced
    static constexpr std::uint16_t kSky = 0xffff;     ///< bright parts of the environment, whatever their luminance
    static constexpr float kContrast = 0.1f;          ///< least relative difference of two values

    /// Whether the pixel has seen a lamp, or a bright sky.
    PL_HD bool is_lit() const { return value > 1; }
    PL_HD float luminance() const { return std::bit_cast<float>(static_cast<std::uint32_t>(value - 1) << 16); }
    /// Whether the two have seen values that differ.
    PL_HD bool differs_from(const EmissionSeen& other) const {
        if (value == 0 || other.value == 0 || value == other.value) return false;
        if (value == kSky || other.value == kSky) return true;
        const float a = luminance();
        const float b = other.luminance();
        return std::fabs(a - b) > kContrast * max_of(a, b);
    }
    /// Kind of the border between two such places: a value of `varies`.
    PL_HD std::uint8_t border_with(const EmissionSeen& other) const {
        if (!differs_from(other)) return 0;
        return value == kSky || other.value == kSky ? kSkyBorder : kLampBorder;
    }
    PL_HD static EmissionSeen of(float luminance) {
        return {static_cast<std::uint16_t>((std::bit_cast<std::uint32_t>(luminance) >> 16) + 1u)};
    }
};

/// One cache line: a sample touches no other.
struct alignas(64) FilmPixel {
    Vec3d sum{0.0};            ///< weighted, of all valid samples: linear sRGB radiance
    Vec3d second_sum{0.0};     ///< of the valid samples of the second half
    std::uint32_t weight = 0;  ///< sum of the weights of valid samples
    std::uint32_t second_weight = 0;
    std::uint32_t invalid = 0;  ///< number of dropped samples: NaN, infinite or negative
    EmissionSeen emission;      ///< by the camera, see camera_emission.h
};

struct FilmView {
    Span<FilmPixel> pixels;  ///< [row][column], row 0 at the top
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint32_t weight = 1;  ///< of the samples of the pass under way
};

/// Weights and counts saturate here; the mean has long converged to float precision.
inline constexpr std::uint32_t kMostWeight = 0xffffffffu;

/// Whether a pixel takes no further sample of this weight.
PL_HD inline bool is_full(const FilmPixel& pixel, std::uint32_t weight) {
    return pixel.weight > kMostWeight - weight;
}

/// Adds the sample of a pass; a pixel must have one writer at a time. Returns false if the sample is invalid. Samples
/// beyond kMostWeight are ignored.
PL_HD inline bool accumulate(const FilmView& film, std::uint32_t pixel, Vec3f radiance, std::uint32_t pass) {
    FilmPixel& p = film.pixels[pixel];
    if (!is_valid_radiance(radiance)) {
        p.invalid += p.invalid < kMostWeight ? 1u : 0u;
        return false;
    }
    if (is_full(p, film.weight)) return true;
    const Vec3d value = static_cast<double>(film.weight) * Vec3d{radiance};
    p.sum += value;
    p.weight += film.weight;
    if (in_second_half(pass)) {
        p.second_sum += value;
        p.second_weight += film.weight;
    }
    return true;
}

/// Adds a correction of a sample that is in the film with this weight: the sample itself is not counted again.
PL_HD inline void correct_sample(const FilmView& film, std::uint32_t pixel, Vec3f correction, std::uint32_t pass,
                                 std::uint32_t weight) {
    FilmPixel& p = film.pixels[pixel];
    if (is_full(p, weight)) return;
    const Vec3d value = static_cast<double>(weight) * Vec3d{correction};
    p.sum += value;
    if (in_second_half(pass)) p.second_sum += value;
}

/// Replaces the contents of a pixel by one sample. Returns false if the sample is invalid.
PL_HD inline bool replace_sample(const FilmView& film, std::uint32_t pixel, Vec3f value, std::uint32_t pass) {
    film.pixels[pixel] = {};
    return accumulate(film, pixel, value, pass);
}

/// Mean radiance of a pixel; 0 before the first sample.
PL_HD inline Vec3f mean_radiance(const FilmPixel& pixel) {
    if (pixel.weight == 0) return Vec3f{0.0f};
    return Vec3f{pixel.sum * (1.0 / static_cast<double>(pixel.weight))};
}

/// Mean radiance, but NaN if all samples were invalid, so that the display marks the pixel.
PL_HD inline Vec3f mean_or_nan(const FilmPixel& pixel) {
    const bool all_invalid = pixel.weight == 0 && pixel.invalid > 0;
    return all_invalid ? Vec3f{kNan} : mean_radiance(pixel);
}

/// Mean of one half of a pixel's samples; NaN if it has none.
PL_HD inline Vec3f half_mean(const FilmPixel& pixel, bool second) {
    const std::uint32_t weight = second ? pixel.second_weight : pixel.weight - pixel.second_weight;
    if (weight == 0) return Vec3f{kNan};
    const Vec3d sum = second ? pixel.second_sum : pixel.sum - pixel.second_sum;
    return Vec3f{sum * (1.0 / static_cast<double>(weight))};
}

}  // namespace pl
