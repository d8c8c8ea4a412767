// Colors, spacing and font of the window.
#pragma once

#include <cstdint>
#include <filesystem>

#include "ui/draw/imgui_draw.h"

namespace pl::ui {

namespace colors {
inline constexpr ImU32 kText = IM_COL32(228, 230, 234, 255);
inline constexpr ImU32 kFaint = IM_COL32(150, 156, 166, 255);
inline constexpr ImU32 kAccent = IM_COL32(92, 168, 255, 255);
inline constexpr ImU32 kGood = IM_COL32(108, 204, 128, 255);
inline constexpr ImU32 kWarning = IM_COL32(255, 184, 76, 255);
inline constexpr ImU32 kError = IM_COL32(255, 112, 104, 255);
inline constexpr ImU32 kBadge = IM_COL32(20, 22, 27, 215);
}  // namespace colors

/// Height of the font in pixels, the unit of all sizes.
inline constexpr float kFontPixels = 16.0f;

/// Height of large text over that of the font.
inline constexpr float kLargeText = 1.4f;
ImFont* large_font();

/// Theme and sizes for a scale of the user interface; 1 is the design size.
void apply_style(float ui_scale);

/// Fills the font atlas, in the font's own and in the large height: the given file, or the built-in font if it is missing.
void load_fonts(const std::filesystem::path& font, float ui_scale);

/// n times the height of the font.
inline float em(float n) { return n * ImGui::GetFontSize(); }

inline ImU32 to_imgui_color(std::uint32_t argb) {
    return IM_COL32(argb >> 16 & 255, argb >> 8 & 255, argb & 255, argb >> 24);
}

inline ImVec4 to_vec4(ImU32 color) { return ImGui::ColorConvertU32ToFloat4(color); }

}  // namespace pl::ui
