// A small picture to draw on: filled rectangles, colored pixels and text in the font of the viewer's window.
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
    /// (x, y) is the upper left corner. Characters that the font lacks are a box.
    void text(int x, int y, std::string_view words, Rgb color);

    static constexpr int kLineHeight = 18;  ///< of a line of text, pixels
    /// Of text on one line, pixels.
    static int text_width(std::string_view words);

    const ByteImage& image() const { return image_; }

private:
    void blend(int x, int y, Rgb color, int level);

    ByteImage image_;
};

}  // namespace pl
