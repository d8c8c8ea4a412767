// Windows that are as they were: copied, and equal to the pixel.
#include "ui/draw/imgui_draw.h"

#include "tests/support/catch.hpp"
#include "ui/draw/stream_texture.h"
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

TEST_CASE("Windows of Dear ImGui: a picture in the place of another of its size is drawn, whatever the addresses") {
    Window window;
    PictureTextures textures(window.offscreen.renderer());
    gui_memory().textures = &textures;
    const auto picture_of = [](std::uint8_t value) {
        return std::make_shared<const ByteImage>(
            ByteImage{.width = 8, .height = 8, .rgb = std::vector<std::uint8_t>(8 * 8 * 3, value)});
    };
    const auto shown = [&](const std::shared_ptr<const ByteImage>& picture) {
        textures.drop_unused();
        const ByteImage pixels = window.offscreen.paint(nullptr, [&] {
            ImGui::SetNextWindowPos({20.0f, 20.0f});
            ImGui::SetNextWindowSize({60.0f, 60.0f});
            ImGui::Begin("picture of a bookmark", nullptr, ImGuiWindowFlags_NoDecoration);
            ImGui::GetWindowDrawList()->AddImage(to_texture_id(texture_of(picture)), {30.0f, 30.0f}, {38.0f, 38.0f});
            ImGui::End();
        });
        return static_cast<int>(pixels.rgb[3 * static_cast<std::size_t>(33 * pixels.width + 33)]);
    };
    std::shared_ptr<const ByteImage> picture;
    // Memory that is free again is taken first: the texture of each has the address of the one before.
    for (const int value : {200, 90, 160}) {
        picture = picture_of(static_cast<std::uint8_t>(value));
        for (int frame = 0; frame < 3; ++frame) CHECK(shown(picture) == value);
    }
    CHECK(window.copied() > 0);
}
