// Dear ImGui during the life of a window: context, platform code, fonts, drawing.
#pragma once

#include <filesystem>
#include <functional>

#include "ui/draw/gui_memory.h"
#include "ui/draw/imgui_draw.h"
#include "ui/draw/picture_textures.h"
#include "ui/window/display.h"
#include "ui/window/mouse_tracker.h"

namespace pl::ui {

class Gui {
public:
    Gui(const Display& display, std::filesystem::path font, float ui_scale);
    ~Gui();
    Gui(const Gui&) = delete;
    Gui& operator=(const Gui&) = delete;

    void handle(const SDL_Event& event);
    /// Closes all menus and lists that are open; false if there was none.
    bool close_popups();
    void set_scale(float ui_scale);
    /// Runs `build` between the start and the end of a frame of this many seconds.
    void frame(double delta_seconds, const std::function<void()>& build);
    /// Draws the last frame.
    void draw();

private:
    const Display& display_;
    std::filesystem::path font_;
    float scale_ = 0.0f;
    ImGuiDraw draw_;
    PictureTextures textures_;
    MouseTracker mouse_;
    GuiMemory memory_;
};

}  // namespace pl::ui
