// Dear ImGui without a window: one frame, drawn into memory by SDL's software renderer, as the window of scripts is. Needs no display.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>

#include "core/io/image.h"
#include "ui/draw/imgui_draw.h"
#include "ui/viewer.h"

struct SDL_Renderer;
struct SDL_Surface;

namespace pl::ui {

/// The pixels of a renderer's target. Throws Error(Runtime).
ByteImage read_pixels(SDL_Renderer* renderer);

class Offscreen {
public:
    /// Size in pixels. `font` as load_fonts() takes it. Throws Error(Unavailable).
    Offscreen(int width, int height, const std::filesystem::path& font, float ui_scale = 1.0f);
    ~Offscreen();
    Offscreen(const Offscreen&) = delete;
    Offscreen& operator=(const Offscreen&) = delete;

    /// One frame: `build` is called inside of a window without a border that fills the picture, over `background` (0xAARRGGBB,
    /// [row][column], as large as the picture), or over the color of panels where that is null.
    ByteImage paint(const std::uint32_t* background, const std::function<void()>& build);
    SDL_Renderer* renderer() const { return renderer_; }
    /// See ImGuiDraw::copied().
    std::size_t copied() const { return draw_->copied(); }

private:
    void put(const std::uint32_t* background);

    int width_;
    int height_;
    SDL_Surface* surface_ = nullptr;
    SDL_Renderer* renderer_ = nullptr;
    GuiMemory memory_;
    std::unique_ptr<ImGuiDraw> draw_;
};

}  // namespace pl::ui
