// Dear ImGui during the life of a window: context, platform code, fonts, drawing.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <limits>

#include <SDL_events.h>

#include "ui/draw/imgui_draw.h"
#include "ui/draw/stream_texture.h"
#include "ui/overlays/overlays.h"
#include "ui/panels/panels.h"
#include "ui/window/display.h"

namespace pl::ui {

/// Pointer and buttons from events. Before 1.87 Dear ImGui's SDL code polls the global pointer instead, which is stale
/// during an X11 grab and misses scripted input.
class MouseTracker {
public:
    void handle(const SDL_Event& event) {
        if (event.type == SDL_MOUSEMOTION) {
            x_ = static_cast<float>(event.motion.x);
            y_ = static_cast<float>(event.motion.y);
        } else if (event.type == SDL_MOUSEBUTTONDOWN || event.type == SDL_MOUSEBUTTONUP) {
            const bool down = event.type == SDL_MOUSEBUTTONDOWN;
            for (std::size_t i = 0; i < kButtons.size(); ++i) {
                if (event.button.button != kButtons[i]) continue;
                down_[i] = down;
                pressed_[i] = pressed_[i] || down;
            }
        } else if (event.type == SDL_WINDOWEVENT && event.window.event == SDL_WINDOWEVENT_LEAVE) {
            x_ = y_ = kNowhere;
        }
    }

    /// After the platform's new frame, before ImGui's. A button is down for at least one frame.
    void write_to_imgui() {
        if constexpr (!kImGuiHasEventQueue) {
            ImGuiIO& io = ImGui::GetIO();
            io.MousePos = {x_, y_};
            for (std::size_t i = 0; i < kButtons.size(); ++i) {
                io.MouseDown[i] = down_[i] || pressed_[i];
                pressed_[i] = false;
            }
        }
    }

    float x() const { return x_; }
    float y() const { return y_; }

private:
    static constexpr float kNowhere = -std::numeric_limits<float>::max();  // ImGui's value for "no mouse"
    static constexpr std::array<Uint8, 3> kButtons{SDL_BUTTON_LEFT, SDL_BUTTON_RIGHT, SDL_BUTTON_MIDDLE};

    float x_ = kNowhere;
    float y_ = kNowhere;
    std::array<bool, 3> down_{};
    std::array<bool, 3> pressed_{};
};

class Gui {
public:
    Gui(const Display& display, std::filesystem::path font, float ui_scale);
    ~Gui();
    Gui(const Gui&) = delete;
    Gui& operator=(const Gui&) = delete;

    void handle(const SDL_Event& event);
    /// Closes all menus and lists that are open; false if there was none.
    bool close_popups();
    void set_look(float ui_scale, Theme theme);
    /// Runs `build` between the start and the end of a frame of this many seconds.
    void frame(double delta_seconds, const std::function<void()>& build);
    /// Draws the last frame.
    void draw();

private:
    const Display& display_;
    std::filesystem::path font_;
    float scale_ = 0.0f;
    Theme theme_ = Theme::Dark;
    ImGuiDraw draw_;
    PictureTextures textures_;
    MouseTracker mouse_;
    GuiMemory memory_;
};

// The panels around and the overlays over the picture.

/// Panels and overlays of a frame of Dear ImGui, the later ones on top. `image` is the rectangle of the picture, `magnifier` null
/// without one.
void draw_interface(ViewerModel& model, const Layout& layout, const Rect& image, const ComparePlan& plan,
                    const std::optional<PixelPosition>& hovered, const Magnifier* magnifier);

}  // namespace pl::ui
