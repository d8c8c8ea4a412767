// Pointer and buttons from events. Before 1.87 Dear ImGui's SDL code polls the global pointer instead, which is stale
// during an X11 grab and misses scripted input.
#pragma once

#include <array>
#include <limits>

#include <SDL_events.h>

#include "ui/draw/imgui_compat.h"

namespace pl::ui {

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

}  // namespace pl::ui
