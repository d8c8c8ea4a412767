// The letters of the viewer's window as bitmaps, for pictures that are made without it.
#pragma once

#include <string_view>

namespace pl {

/// A letter of 16 pixels height.
struct PixelGlyph {
    int advance;  ///< to the next letter, pixels
    int left;     ///< of the bitmap, from the pen
    int top;      ///< of the bitmap, from the upper edge of the line
    int width;    ///< of the bitmap
    int height;
    std::string_view coverage;  ///< of its pixels, a hexadecimal digit each, row by row

    static constexpr int kMostCoverage = 15;
    /// 0 to kMostCoverage.
    int level(int column, int row) const;
};

/// Printable ASCII; anything else is a box.
const PixelGlyph& pixel_glyph(char c);

}  // namespace pl
