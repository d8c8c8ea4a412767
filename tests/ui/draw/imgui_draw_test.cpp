// Windows that are as they were: copied, and equal to the pixel.
#include "ui/draw/imgui_draw.h"

#include "tests/support/catch.hpp"
#include "ui/window/offscreen.h"

using namespace pl;
using namespace pl::ui;

namespace {

/// Two windows beside each other, the right one over the corner of the left one.
void build_windows(const char* text, float alpha) {
    for (const float x : {10.0f, 90.0f}) {
        ImGui::SetNextWindowPos({x, x});
        ImGui::SetNextWindowSize({100.0f, 80.0f});
        ImGui::SetNextWindowBgAlpha(alpha);
        ImGui::Begin(x < 50.0f ? "left" : "right", nullptr, ImGuiWindowFlags_NoDecoration);
        ImGui::TextUnformatted(x < 50.0f ? "fixed" : text);
        ImGui::Button("button");
        ImGui::End();
    }
}

/// Pixels that differ.
int difference(const ByteImage& a, const ByteImage& b) {
    int count = 0;
    for (std::size_t i = 0; i < a.rgb.size(); i += 3)
        count += std::equal(a.rgb.begin() + i, a.rgb.begin() + i + 3, b.rgb.begin() + i) ? 0 : 1;
    return count;
}

struct Window {
    Offscreen offscreen{200, 180, ""};

    ByteImage paint(const char* text, float alpha = 1.0f) {
        return offscreen.paint(nullptr, [&] { build_windows(text, alpha); });
    }
    std::size_t copied() const { return offscreen.copied(); }
};

}  // namespace

TEST_CASE("Windows of Dear ImGui: those that do not change are copied, to the pixel") {
    Window window;
    const ByteImage drawn = window.paint("a");
    CHECK(window.copied() == 0);
    for (int frame = 0; frame < 3; ++frame) {
        CHECK(difference(window.paint("a"), drawn) == 0);
        CHECK(window.copied() == 2);
    }
    // One changes, the other is copied.
    const ByteImage other = window.paint("b");
    CHECK(window.copied() == 1);
    CHECK(difference(other, drawn) > 0);
    CHECK(difference(window.paint("b"), other) == 0);
    CHECK(window.copied() == 2);
}

TEST_CASE("Windows of Dear ImGui: what shines through is drawn anew in every frame") {
    Window window;
    window.paint("a", 0.5f);
    const ByteImage drawn = window.paint("a", 0.5f);
    CHECK(difference(window.paint("a", 0.5f), drawn) == 0);
    CHECK(window.copied() == 0);
}
