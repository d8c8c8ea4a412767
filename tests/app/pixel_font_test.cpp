// Pictures have the letters of the window: the same font, rasterized as Dear ImGui does for it.
#include "app/pixel_font.h"

#include <cmath>
#include <cstdlib>
#include <string>

#include <imgui.h>

#include "tests/support/catch.hpp"

namespace pl {

#if IMGUI_VERSION_NUM < 19200  // later ones have no atlas of all letters

// Coverage has 16 levels here and 256 there: at most 10 of 255 apart.
TEST_CASE("the letters of pictures are the window's") {
    ImFontAtlas atlas;
    ImFontConfig config;  // as load_fonts()
    config.OversampleH = 1;
    config.OversampleV = 1;
    config.PixelSnapH = true;
    const std::string file = std::string(PL_SOURCE_DIR) + "/assets/fonts/roboto-medium-latin.ttf";
    ImFont* font = atlas.AddFontFromFileTTF(file.c_str(), 16.0f, &config);
    REQUIRE(font != nullptr);
    unsigned char* pixels = nullptr;
    int width = 0;
    int height = 0;
    atlas.GetTexDataAsAlpha8(&pixels, &width, &height);
    for (int c = '!'; c <= '~'; ++c) {
        CAPTURE(static_cast<char>(c));
        const ImFontGlyph& theirs = *font->FindGlyph(static_cast<ImWchar>(c));
        const PixelGlyph& ours = pixel_glyph(static_cast<char>(c));
        CHECK(ours.advance == std::lround(theirs.AdvanceX));
        CHECK(ours.left == std::lround(theirs.X0));
        CHECK(ours.top == std::lround(theirs.Y0));
        REQUIRE(ours.width == std::lround(theirs.X1 - theirs.X0));
        REQUIRE(ours.height == std::lround(theirs.Y1 - theirs.Y0));
        const int u = static_cast<int>(std::lround(theirs.U0 * static_cast<float>(width)));
        const int v = static_cast<int>(std::lround(theirs.V0 * static_cast<float>(height)));
        int most = 0;
        for (int row = 0; row < ours.height; ++row)
            for (int column = 0; column < ours.width; ++column)
                most =
                    std::max(most, std::abs(17 * ours.level(column, row) - pixels[(v + row) * width + u + column]));
        CHECK(most <= 10);
    }
}

#endif

}  // namespace pl
