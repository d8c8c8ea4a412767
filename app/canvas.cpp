#include "app/canvas.h"

#include "app/pixel_font.h"

namespace pl {

Canvas::Canvas(int width, int height, Rgb background) : image_{.width = width, .height = height, .rgb = {}} {
    image_.rgb.resize(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    fill(0, 0, width, height, background);
}

void Canvas::put(int x, int y, Rgb color) {
    if (x < 0 || y < 0 || x >= image_.width || y >= image_.height) return;
    const auto index =
        3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image_.width) + static_cast<std::size_t>(x));
    for (std::size_t channel = 0; channel < 3; ++channel) image_.rgb[index + channel] = color[channel];
}

void Canvas::fill(int x, int y, int width, int height, Rgb color) {
    for (int row = y; row < y + height; ++row)
        for (int column = x; column < x + width; ++column) put(column, row, color);
}

int Canvas::text_width(std::string_view words) {
    int width = 0;
    for (const char c : words) width += pixel_glyph(c).advance;
    return width;
}

void Canvas::text(int x, int y, std::string_view words, Rgb color) {
    for (const char c : words) {
        const PixelGlyph& glyph = pixel_glyph(c);
        for (int row = 0; row < glyph.height; ++row)
            for (int column = 0; column < glyph.width; ++column)
                blend(x + glyph.left + column, y + glyph.top + row, color, glyph.level(column, row));
        x += glyph.advance;
    }
}

/// `level`: share of the color, in parts of PixelGlyph::kMostCoverage.
void Canvas::blend(int x, int y, Rgb color, int level) {
    if (x < 0 || y < 0 || x >= image_.width || y >= image_.height || level == 0) return;
    const auto index =
        3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image_.width) + static_cast<std::size_t>(x));
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const int below = image_.rgb[index + channel];
        image_.rgb[index + channel] =
            static_cast<std::uint8_t>(below + (color[channel] - below) * level / PixelGlyph::kMostCoverage);
    }
}

}  // namespace pl
