// From film pixels to the 8-bit pixels of the display: one function for all back ends.
#pragma once

#include "core/kernel/film/film_view.h"
#include "core/kernel/film/heat_color.h"
#include "core/kernel/film/tone_table.h"

namespace pl {

/// Display mapping of a film.
struct FrameStyle {
    float scale = 1.0f;  ///< multiplies linear values: exposure, or 1 / range of a view
    ToneCurve curve = ToneCurve::Clamp;
    std::uint32_t heat = 0;  ///< 1: the red channel is a scalar, shown by heat_color() without a tone curve
};

/// Marker of pixels with invalid samples only: opaque magenta.
inline constexpr std::uint32_t kInvalidPixel = 0xffff00ffu;

/// Opaque ARGB, 8 bits each, A in the highest.
PL_HD inline std::uint32_t pack_pixel(std::uint32_t r, std::uint32_t g, std::uint32_t b) {
    return 0xff000000u | r << 16 | g << 8 | b;
}

/// Display value of a pixel. `codes` must be the codes of style.curve.
PL_HD inline std::uint32_t frame_pixel(Vec3f value, const FrameStyle& style, const ToneCodes& codes) {
    if (style.heat != 0) {
        const ByteColor color = heat_color(value.x * style.scale);
        return pack_pixel(color.r, color.g, color.b);
    }
    if (value.x != value.x || value.y != value.y || value.z != value.z) return kInvalidPixel;
    return pack_pixel(codes(value.x * style.scale), codes(value.y * style.scale), codes(value.z * style.scale));
}

/// Contribution of a pixel to the automatic range of a heat map: its red channel if positive and finite, else 0.
PL_HD inline float range_value(const FilmPixel& pixel) {
    const float value = mean_or_nan(pixel).x;
    return value > 0.0f && value < kInfinity ? value : 0.0f;
}

}  // namespace pl
