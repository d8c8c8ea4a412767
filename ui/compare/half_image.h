// Pixels of stored pictures: half floats to 8-bit, differences, error maps.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/kernel/film/tone_table.h"
#include "core/measure/live_runs.h"
#include "core/session/settings.h"

namespace pl::ui {

/// The 8-bit code of every half float under a display setting: a picture is converted by table lookup.
class HalfCodes {
public:
    explicit HalfCodes(const DisplaySettings& display);

    const DisplaySettings& display() const { return display_; }
    /// Opaque ARGB of three channels; the marker of invalid pixels if one is NaN.
    std::uint32_t pixel(const std::uint16_t* rgb) const;

private:
    static constexpr std::uint16_t kNaN = 0x100;  ///< no code

    DisplaySettings display_;
    std::vector<std::uint16_t> codes_;
};

/// Linear value of a pixel by its index.
Vec3f pixel_of(const HalfPicture& picture, std::size_t index);

/// ARGB rows, `pitch` pixels apart.
void write_half_picture(const HalfPicture& picture, const HalfCodes& codes, std::uint32_t* out, std::size_t pitch);

/// |a - b| by channel, under the same exposure and curve. Sizes must agree.
void write_difference(const HalfPicture& a, const HalfPicture& b, const DisplaySettings& display, std::uint32_t* out,
                      std::size_t pitch);

/// Relative errors of the darkest and the lightest color of an error map; the scale is logarithmic.
inline constexpr float kLowError = 0.01f;
inline constexpr float kHighError = 10.0f;
/// Square root of one pixel's term of Metrics::relmse; NaN for values that are not finite.
float pixel_error(Vec3f picture, Vec3f reference);
/// Colors of heat_color(). Sizes must agree.
void write_error_map(const HalfPicture& picture, const HalfPicture& reference, std::uint32_t* out, std::size_t pitch);
/// The legend of the colors.
std::string error_map_legend();

}  // namespace pl::ui
