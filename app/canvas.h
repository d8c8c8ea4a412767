// A small picture to draw on: filled rectangles, colored pixels and text in a built-in font.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/io/image.h"

namespace pl {

using Rgb = std::array<std::uint8_t, 3>;

class Canvas {
public:
    Canvas(int width, int height, Rgb background);

    /// Clipped to the picture.
    void put(int x, int y, Rgb color);
    void fill(int x, int y, int width, int height, Rgb color);
    /// (x, y) is the upper left corner. Lower case is drawn as upper case, characters that the font lacks as a box.
    void text(int x, int y, std::string_view words, Rgb color, int scale = 2);

    static constexpr int kAdvance = 6;     ///< width of a character, in units of the scale
    static constexpr int kLineHeight = 9;  ///< of a line of text, in units of the scale

    const ByteImage& image() const { return image_; }

private:
    void glyph(int x, int y, char c, Rgb color, int scale);

    ByteImage image_;
};

}  // namespace pl
