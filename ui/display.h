// The window and its renderer.
#pragma once

#include <string>

#include "ui/viewer.h"

struct SDL_Window;
struct SDL_Renderer;

namespace pl {

/// Is there a screen to open a window on, or did SDL_VIDEODRIVER ask for another one? If not, `why` says so in one
/// line. Opens no window.
bool display_available(std::string* why = nullptr);

/// Owner of window and renderer. Chooses an accelerated renderer if it runs on hardware: on a software
/// implementation of OpenGL plain pixels are several times faster.
class Display {
public:
    /// Throws Error(Unavailable).
    Display(const std::string& title, int width, int height, bool software);
    ~Display();
    Display(const Display&) = delete;
    Display& operator=(const Display&) = delete;

    SDL_Window* window() const { return window_; }
    SDL_Renderer* renderer() const { return renderer_; }
    /// "opengl (NVIDIA ...)", "software".
    const std::string& renderer_name() const { return name_; }
    bool is_software() const { return software_; }

    void set_title(const std::string& title);
    void toggle_full_screen();
    /// Everything drawn since the last present(); slow.
    ScreenPixels read_pixels() const;

private:
    bool open(const std::string& title, int width, int height, bool software);
    bool runs_on_hardware();
    void close();

    SDL_Window* window_ = nullptr;
    SDL_Renderer* renderer_ = nullptr;
    std::string name_;
    bool software_ = false;
};

}  // namespace pl
