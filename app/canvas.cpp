#include "app/canvas.h"

#include <cctype>

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

void Canvas::text(int x, int y, std::string_view words, Rgb color, int scale) {
    for (const char c : words) {
        glyph(x, y, static_cast<char>(std::toupper(static_cast<unsigned char>(c))), color, scale);
        x += kAdvance * scale;
    }
}

void Canvas::glyph(int x, int y, char c, Rgb color, int scale) {
    const PixelGlyph shape = pixel_glyph(c);
    for (int row = 0; row < kGlyphHeight; ++row)
        for (int column = 0; column < kGlyphWidth; ++column)
            if (shape.is_set(column, row)) fill(x + column * scale, y + row * scale, scale, scale, color);
}

}  // namespace pl
