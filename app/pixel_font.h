// Letters of 5 x 7 pixels, for pictures that are made without a font file.
#pragma once

#include <string_view>

namespace pl {

inline constexpr int kGlyphWidth = 5;
inline constexpr int kGlyphHeight = 7;

/// Seven rows of five characters with a space between rows; '#' is ink.
struct PixelGlyph {
    std::string_view rows;
    bool is_set(int column, int row) const {
        return rows[static_cast<std::size_t>(row * (kGlyphWidth + 1) + column)] == '#';
    }
};

/// Digits, upper case letters and the punctuation of numbers; anything else is a box.
PixelGlyph pixel_glyph(char c);

}  // namespace pl
