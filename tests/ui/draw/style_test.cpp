// The colors of the themes: contrast of text by the definition of the Web Content Accessibility Guidelines 2.1.
#include "ui/draw/style.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/session/methods.h"
#include "tests/support/catch.hpp"

using namespace pl::ui;

namespace {

float linear(float channel) {
    return channel <= 0.04045f ? channel / 12.92f : std::pow((channel + 0.055f) / 1.055f, 2.4f);
}

float luminance(ImVec4 color) {
    return 0.2126f * linear(color.x) + 0.7152f * linear(color.y) + 0.0722f * linear(color.z);
}

float contrast(ImVec4 a, ImVec4 b) {
    const float first = luminance(a), second = luminance(b);
    return (std::max(first, second) + 0.05f) / (std::min(first, second) + 0.05f);
}

/// Grounds of text: of panels, dialogs, controls at rest and under the pointer, and of what is chosen.
constexpr std::array kGrounds{ImGuiCol_WindowBg,      ImGuiCol_ChildBg,       ImGuiCol_PopupBg,
                              ImGuiCol_MenuBarBg,     ImGuiCol_FrameBg,       ImGuiCol_FrameBgHovered,
                              ImGuiCol_FrameBgActive, ImGuiCol_TitleBgActive, ImGuiCol_Button,
                              ImGuiCol_ButtonHovered, ImGuiCol_ButtonActive,  ImGuiCol_Header,
                              ImGuiCol_HeaderHovered, ImGuiCol_HeaderActive,  ImGuiCol_Tab,
                              ImGuiCol_TabHovered,    ImGuiCol_TableHeaderBg, ImGuiCol_TableRowBgAlt};

/// Grounds of values that controls fill: their text is kText.
constexpr std::array kFilled{ImGuiCol_SliderGrab, ImGuiCol_SliderGrabActive, ImGuiCol_PlotHistogram};

/// Least contrast of a color of text on all grounds, also those over the picture and of plots.
float least_contrast(ImU32 text) {
    float least = std::min(contrast(to_vec4(text), to_vec4(colors::kGround)),
                           contrast(to_vec4(text), to_vec4(colors::kBadge | 0xff000000u)));
    for (const int ground : kGrounds)
        least = std::min(least, contrast(to_vec4(text), ImGui::GetStyle().Colors[ground]));
    return least;
}

float least_contrast_of_filled() {
    float least = 21.0f;
    for (const int ground : kFilled)
        least = std::min(least, contrast(to_vec4(colors::kText), ImGui::GetStyle().Colors[ground]));
    return least;
}

struct StyleBench {
    StyleBench() { ImGui::CreateContext(); }
    ~StyleBench() { ImGui::DestroyContext(); }
};

}  // namespace

TEST_CASE("Style: high contrast has 7:1 or more in all text on all grounds") {
    const StyleBench bench;
    apply_style(1.0f, Theme::HighContrast);
    CHECK(contrast({1, 1, 1, 1}, {0, 0, 0, 1}) == Approx(21.0f));
    for (const ImU32 text :
         {colors::kText, colors::kFaint, colors::kAccent, colors::kGood, colors::kWarning, colors::kError}) {
        CAPTURE(text);
        CHECK(least_contrast(text) >= 7.0f);
    }
    CHECK(least_contrast_of_filled() >= 7.0f);
}

TEST_CASE("Style: text of the other themes has 4.5:1 or more on all grounds") {
    const StyleBench bench;
    for (const Theme theme : {Theme::Dark, Theme::Light}) {
        CAPTURE(static_cast<int>(theme));
        apply_style(1.0f, theme);
        CHECK(least_contrast(colors::kText) >= 4.5f);
        CHECK(least_contrast_of_filled() >= 4.5f);
    }
}

TEST_CASE("Style: names in the colors of runs have 4.5:1 or more on badges and plots") {
    const StyleBench bench;
    for (const Theme theme : {Theme::Dark, Theme::Light, Theme::HighContrast}) {
        apply_style(1.0f, theme);
        for (const pl::MethodInfo& method : pl::all_methods()) {
            CAPTURE(static_cast<int>(theme), method.name);
            const ImVec4 text = to_vec4(to_text_color(method.color));
            CHECK(contrast(text, to_vec4(colors::kGround)) >= 4.5f);
            CHECK(contrast(text, to_vec4(colors::kBadge | 0xff000000u)) >= 4.5f);
        }
    }
}
