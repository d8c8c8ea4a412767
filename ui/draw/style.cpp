#include "ui/draw/style.h"

#include <cmath>

namespace pl::ui {
namespace {

ImVec4 rgb(int hex) {
    return {static_cast<float>(hex >> 16 & 255) / 255.0f, static_cast<float>(hex >> 8 & 255) / 255.0f,
            static_cast<float>(hex & 255) / 255.0f, 1.0f};
}

void apply_colors(ImVec4* c) {
    c[ImGuiCol_Text] = to_vec4(colors::kText);
    c[ImGuiCol_TextDisabled] = to_vec4(colors::kFaint);
    // Opaque: blending whole panels would take most of the time of a software renderer.
    c[ImGuiCol_WindowBg] = rgb(0x1b1e24);
    c[ImGuiCol_ChildBg] = rgb(0x16181d);
    c[ImGuiCol_PopupBg] = rgb(0x22262e);
    c[ImGuiCol_MenuBarBg] = rgb(0x14161a);
    c[ImGuiCol_Border] = rgb(0x343a45);
    c[ImGuiCol_FrameBg] = rgb(0x2a2f39);
    c[ImGuiCol_FrameBgHovered] = rgb(0x353c49);
    c[ImGuiCol_FrameBgActive] = rgb(0x3d4656);
    c[ImGuiCol_TitleBg] = c[ImGuiCol_TitleBgActive] = rgb(0x14161a);
    c[ImGuiCol_Button] = rgb(0x323946);
    c[ImGuiCol_ButtonHovered] = rgb(0x3f495a);
    c[ImGuiCol_ButtonActive] = rgb(0x2f6bb0);
    c[ImGuiCol_Header] = rgb(0x272c35);
    c[ImGuiCol_HeaderHovered] = rgb(0x323946);
    c[ImGuiCol_HeaderActive] = rgb(0x3a4352);
    c[ImGuiCol_CheckMark] = to_vec4(colors::kAccent);
    c[ImGuiCol_SliderGrab] = rgb(0x5ca8ff);
    c[ImGuiCol_SliderGrabActive] = rgb(0x8cc2ff);
    c[ImGuiCol_Separator] = rgb(0x343a45);
    c[ImGuiCol_Tab] = rgb(0x20242b);
    c[ImGuiCol_TabHovered] = rgb(0x3f495a);
#if IMGUI_VERSION_NUM >= 19090
    c[ImGuiCol_TabSelected] = c[ImGuiCol_TabDimmedSelected] = rgb(0x2f6bb0);
    c[ImGuiCol_TabDimmed] = c[ImGuiCol_Tab];
#else
    c[ImGuiCol_TabActive] = c[ImGuiCol_TabUnfocusedActive] = rgb(0x2f6bb0);
    c[ImGuiCol_TabUnfocused] = c[ImGuiCol_Tab];
#endif
    c[ImGuiCol_ScrollbarBg] = rgb(0x16181d);
    c[ImGuiCol_ScrollbarGrab] = rgb(0x3a4352);
    c[ImGuiCol_TableHeaderBg] = rgb(0x272c35);
    c[ImGuiCol_TableBorderLight] = rgb(0x2c323c);
    c[ImGuiCol_TableRowBgAlt] = rgb(0x1f232a);
    c[ImGuiCol_PlotHistogram] = rgb(0x5ca8ff);
}

}  // namespace

void apply_style(float ui_scale) {
    ImGuiStyle style;
    apply_colors(style.Colors);
    style.WindowRounding = 0.0f;
    style.FrameRounding = 3.0f;
    style.GrabRounding = 3.0f;
    style.PopupRounding = 3.0f;
    style.ScrollbarRounding = 3.0f;
    style.TabRounding = 3.0f;
    style.WindowBorderSize = 1.0f;
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

ImFont* large_font() { return ImGui::GetIO().Fonts->Fonts.back(); }

}  // namespace pl::ui
