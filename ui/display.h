// The window and its renderer.
#pragma once

#include <string>

#include "ui/viewer.h"

struct SDL_Window;
struct SDL_Renderer;

namespace pl {

/// Keeps SDL's video part running. Throws Error(Unavailable) with one line where there is no screen to open a window
/// on, unless SDL_VIDEODRIVER asked for a driver that needs none. The driver is looked at in the connection that is then
/// used: an X server may start afresh when its last client leaves, and refuse the next for a moment.
class VideoSubsystem {
public:
    VideoSubsystem();
    ~VideoSubsystem();
    VideoSubsystem(const VideoSubsystem&) = delete;
    VideoSubsystem& operator=(const VideoSubsystem&) = delete;
};

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

    VideoSubsystem video_;
    SDL_Window* window_ = nullptr;
    SDL_Renderer* renderer_ = nullptr;
    std::string name_;
    bool software_ = false;
};

}  // namespace pl
