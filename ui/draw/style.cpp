#include "ui/draw/style.h"

#include <array>
#include <cmath>

namespace pl::ui {
namespace {

ImVec4 rgb(int hex) {
    return {static_cast<float>(hex >> 16 & 255) / 255.0f, static_cast<float>(hex >> 8 & 255) / 255.0f,
            static_cast<float>(hex & 255) / 255.0f, 1.0f};
}

/// 0xRRGGBB in each theme.
using Shade = std::array<int, kThemeCount>;

void apply_colors(ImVec4* c, Theme theme) {
    const auto hex = [&](const Shade& shade) { return shade[static_cast<std::size_t>(theme)]; };
    const auto opaque = [&](const Shade& shade) { return ImGui::ColorConvertFloat4ToU32(rgb(hex(shade))); };
    colors::kText = opaque({0xe4e6ea, 0x15181d, 0xffffff});
    colors::kFaint = opaque({0x969ca6, 0x555c68, 0xdcdcdc});
    colors::kAccent = opaque({0x5ca8ff, 0x0b57a8, 0x8fd0ff});
    colors::kGood = opaque({0x6ccc80, 0x146c2e, 0x7dff8a});
    colors::kWarning = opaque({0xffb84c, 0x8a4b00, 0xffd84c});
    colors::kError = opaque({0xff7068, 0xb3261e, 0xffaaa4});
    colors::kBadge = (opaque({0x14161b, 0xf4f5f7, 0x000000}) & 0x00ffffffu) | 0xd7000000u;
    colors::kGround = opaque({0x101216, 0xffffff, 0x000000});
    colors::kGrid = opaque({0x343a45, 0xbfc4cc, 0x7a7a7a});
    colors::kMinorGrid = opaque({0x20242b, 0xe6e8ec, 0x3c3c3c});
    const auto set = [&](int index, const Shade& shade) { c[index] = rgb(hex(shade)); };
    c[ImGuiCol_Text] = to_vec4(colors::kText);
    c[ImGuiCol_TextDisabled] = to_vec4(colors::kFaint);
    c[ImGuiCol_CheckMark] = to_vec4(colors::kAccent);
    // Opaque: blending whole panels would take most of the time of a software renderer.
    set(ImGuiCol_WindowBg, {0x1b1e24, 0xeff1f4, 0x000000});
    set(ImGuiCol_ChildBg, {0x16181d, 0xf8f9fa, 0x000000});
    set(ImGuiCol_PopupBg, {0x22262e, 0xffffff, 0x000000});
    set(ImGuiCol_MenuBarBg, {0x14161a, 0xe0e3e8, 0x000000});
    set(ImGuiCol_Border, {0x343a45, 0xb4bac4, 0xb4b4b4});
    set(ImGuiCol_FrameBg, {0x2a2f39, 0xffffff, 0x141414});
    set(ImGuiCol_FrameBgHovered, {0x353c49, 0xe3eaf4, 0x242424});
    set(ImGuiCol_FrameBgActive, {0x3d4656, 0xd2def0, 0x2a2a2a});
    set(ImGuiCol_TitleBg, {0x14161a, 0xd6dae0, 0x000000});
    set(ImGuiCol_TitleBgActive, {0x14161a, 0xd6dae0, 0x000000});
    set(ImGuiCol_Button, {0x323946, 0xd4d9e1, 0x1e1e1e});
    set(ImGuiCol_ButtonHovered, {0x3f495a, 0xc0c9d6, 0x2a2a2a});
    set(ImGuiCol_ButtonActive, {0x2c66a8, 0x8fbdf0, 0x00284f});
    set(ImGuiCol_Header, {0x272c35, 0xdde1e8, 0x1e1e1e});
    set(ImGuiCol_HeaderHovered, {0x323946, 0xccd5e2, 0x2a2a2a});
    set(ImGuiCol_HeaderActive, {0x3a4352, 0xb9c7da, 0x00284f});
    set(ImGuiCol_SliderGrab, {0x2c66a8, 0x8fbdf0, 0x0055aa});
    set(ImGuiCol_SliderGrabActive, {0x24548a, 0x6fa6e2, 0x00478f});
    set(ImGuiCol_Separator, {0x343a45, 0xb4bac4, 0xb4b4b4});
    set(ImGuiCol_Tab, {0x20242b, 0xd4d9e1, 0x1e1e1e});
    set(ImGuiCol_TabHovered, {0x3f495a, 0xc0c9d6, 0x2a2a2a});
#if IMGUI_VERSION_NUM >= 19090
    set(ImGuiCol_TabSelected, {0x2c66a8, 0x8fbdf0, 0x00284f});
    c[ImGuiCol_TabDimmedSelected] = c[ImGuiCol_TabSelected];
    c[ImGuiCol_TabDimmed] = c[ImGuiCol_Tab];
#else
    set(ImGuiCol_TabActive, {0x2c66a8, 0x8fbdf0, 0x00284f});
    c[ImGuiCol_TabUnfocusedActive] = c[ImGuiCol_TabActive];
    c[ImGuiCol_TabUnfocused] = c[ImGuiCol_Tab];
#endif
    set(ImGuiCol_ScrollbarBg, {0x16181d, 0xe0e3e8, 0x000000});
    set(ImGuiCol_ScrollbarGrab, {0x3a4352, 0xb0b8c4, 0xb4b4b4});
    set(ImGuiCol_TableHeaderBg, {0x272c35, 0xdde1e8, 0x1e1e1e});
    set(ImGuiCol_TableBorderLight, {0x2c323c, 0xc8cdd5, 0x7a7a7a});
    set(ImGuiCol_TableRowBgAlt, {0x1f232a, 0xe6e9ee, 0x141414});
    set(ImGuiCol_PlotHistogram, {0x2c66a8, 0x8fbdf0, 0x0055aa});
}

}  // namespace

void apply_style(float ui_scale, Theme theme) {
    ImGuiStyle style;
    apply_colors(style.Colors, theme);
    style.WindowRounding = 0.0f;
    style.FrameRounding = 3.0f;
    style.GrabRounding = 3.0f;
    style.PopupRounding = 3.0f;
    style.ScrollbarRounding = 3.0f;
    style.TabRounding = 3.0f;
    style.WindowBorderSize = 1.0f;
    style.FrameBorderSize = theme == Theme::Dark ? 0.0f : 1.0f;  // boxes of the others are as bright as their ground
    style.WindowPadding = {10.0f, 10.0f};
    style.FramePadding = {7.0f, 3.0f};
    style.ItemSpacing = {8.0f, 4.0f};
    style.ItemInnerSpacing = {6.0f, 4.0f};
    style.ScrollbarSize = 12.0f;
    style.GrabMinSize = 12.0f;
    // A software renderer draws textured one-pixel lines thick and ragged.
    style.AntiAliasedLinesUseTex = false;
    style.ScaleAllSizes(ui_scale);
    ImGui::GetStyle() = style;
}

namespace {

void add_font(ImFontAtlas& atlas, const std::filesystem::path& font, float pixels) {
    static const ImWchar kRanges[] = {0x0020, 0x00ff, 0x2013, 0x2026, 0x2212, 0x2212, 0x2264, 0x2265, 0};
    std::error_code ignored;
    if (!font.empty() && std::filesystem::is_regular_file(font, ignored)) {
        ImFontConfig config;
        // Whole pixels: a software renderer takes the nearest texel, and letters would be spaced unevenly.
        config.OversampleH = 1;
        config.OversampleV = 1;
        config.PixelSnapH = true;
        if (atlas.AddFontFromFileTTF(font.string().c_str(), pixels, &config, kRanges) != nullptr) return;
    }
    ImFontConfig config;
    config.SizePixels = pixels;
    atlas.AddFontDefault(&config);
}

}  // namespace

void load_fonts(const std::filesystem::path& font, float ui_scale) {
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    atlas.Clear();
    for (const float height : {1.0f, kLargeText}) add_font(atlas, font, std::round(kFontPixels * ui_scale * height));
}

ImU32 to_text_color(std::uint32_t argb) {
    constexpr float kOnLight = 0.5f;
    const ImVec4 color = to_vec4(to_imgui_color(argb));
    const bool is_light = to_vec4(colors::kGround).x > 0.5f;
    const float scale = is_light ? kOnLight : 1.0f;
    return ImGui::ColorConvertFloat4ToU32({scale * color.x, scale * color.y, scale * color.z, color.w});
}

ImFont* large_font() { return ImGui::GetIO().Fonts->Fonts.back(); }

}  // namespace pl::ui
