// Colors, spacing and font of the window.
#pragma once

#include <cstdint>
#include <filesystem>

#include "ui/draw/imgui_draw.h"
#include "ui/draw/theme.h"

namespace pl::ui {

/// Of the theme, see apply_style().
namespace colors {
inline ImU32 kText = 0;
inline ImU32 kFaint = 0;
inline ImU32 kAccent = 0;
inline ImU32 kGood = 0;
inline ImU32 kWarning = 0;
inline ImU32 kError = 0;
inline ImU32 kBadge = 0;   ///< behind text over the picture
inline ImU32 kGround = 0;  ///< of plots
inline ImU32 kGrid = 0;
inline ImU32 kMinorGrid = 0;
}  // namespace colors

/// Height of the font in pixels, the unit of all sizes.
inline constexpr float kFontPixels = 16.0f;

/// Height of large text over the height of the font.
inline constexpr float kLargeText = 1.4f;
ImFont* large_font();

/// Colors of a theme, and sizes for a scale of the user interface; 1 is the design size.
void apply_style(float ui_scale, Theme theme = Theme::Dark);

/// Fills the font atlas, in the font's own and in the large height: the given file, or the built-in font if it is missing.
void load_fonts(const std::filesystem::path& font, float ui_scale);

/// n times the height of the font.
inline float em(float n) { return n * ImGui::GetFontSize(); }

inline ImU32 to_imgui_color(std::uint32_t argb) {
    return IM_COL32(argb >> 16 & 255, argb >> 8 & 255, argb & 255, argb >> 24);
}

/// A bright color as text: darker on a light ground.
ImU32 to_text_color(std::uint32_t argb);

inline ImVec4 to_vec4(ImU32 color) { return ImGui::ColorConvertU32ToFloat4(color); }

}  // namespace pl::ui
