#include "ui/compare/half_image.h"

#include <cmath>

#include <fmt/format.h>

#include "core/kernel/base/half.h"
#include "core/kernel/film/frame_pixel.h"
#include "core/measure/metrics.h"

namespace pl::ui {
namespace {

/// Calls `color` with the index of every pixel, and writes its result.
template <class Color>
void write_pixels(const HalfPicture& size, std::uint32_t* out, std::size_t pitch, Color color) {
    const auto width = static_cast<std::size_t>(size.width);
    for (std::size_t y = 0; y < static_cast<std::size_t>(size.height); ++y)
        for (std::size_t x = 0; x < width; ++x) out[y * pitch + x] = color(y * width + x);
}

}  // namespace

Vec3f pixel_of(const HalfPicture& picture, std::size_t index) {
    const std::uint16_t* rgb = picture.rgb.data() + 3 * index;
    return {from_half(rgb[0]), from_half(rgb[1]), from_half(rgb[2])};
}

HalfCodes::HalfCodes(const DisplaySettings& display) : display_(display), codes_(1u << 16) {
    const ToneTable table(display.curve);
    const float scale = std::exp2(display.exposure_ev);
    for (std::uint32_t bits = 0; bits < codes_.size(); ++bits) {
        const float value = from_half(static_cast<std::uint16_t>(bits));
        codes_[bits] = std::isnan(value) ? kNaN : table(value * scale);
    }
}

std::uint32_t HalfCodes::pixel(const std::uint16_t* rgb) const {
    const std::uint16_t r = codes_[rgb[0]], g = codes_[rgb[1]], b = codes_[rgb[2]];
    return r == kNaN || g == kNaN || b == kNaN ? kInvalidPixel : pack_pixel(r, g, b);
}

void write_half_picture(const HalfPicture& picture, const HalfCodes& codes, std::uint32_t* out, std::size_t pitch) {
    write_pixels(picture, out, pitch, [&](std::size_t i) { return codes.pixel(picture.rgb.data() + 3 * i); });
}

void write_difference(const HalfPicture& a, const HalfPicture& b, const DisplaySettings& display, std::uint32_t* out,
                      std::size_t pitch) {
    const ToneTable table(display.curve);
    const FrameStyle style{.scale = std::exp2(display.exposure_ev), .curve = display.curve};
    write_pixels(a, out, pitch, [&](std::size_t i) {
        return frame_pixel(glm::abs(pixel_of(a, i) - pixel_of(b, i)), style, table.view());
    });
}

float pixel_error(Vec3f picture, Vec3f reference) {
    const Vec3f difference = picture - reference;
    const Vec3f squares = difference * difference / (reference * reference + Vec3f{static_cast<float>(kEpsilon)});
    return std::sqrt((squares.x + squares.y + squares.z) / 3.0f);
}

void write_error_map(const HalfPicture& picture, const HalfPicture& reference, std::uint32_t* out,
                     std::size_t pitch) {
    const float scale = 1.0f / std::log(kHighError / kLowError);
    write_pixels(picture, out, pitch, [&](std::size_t i) {
        const float error = pixel_error(pixel_of(picture, i), pixel_of(reference, i));
        const ByteColor color = heat_color(error > 0.0f ? std::log(error / kLowError) * scale : error);
        return pack_pixel(color.r, color.g, color.b);
    });
}

std::string error_map_legend() { return fmt::format("relative error {:g} to {:g}", kLowError, kHighError); }

}  // namespace pl::ui
