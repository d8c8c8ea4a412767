// The window and its renderer.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "ui/model/window_state.h"
#include "ui/viewer.h"

struct SDL_Window;
struct SDL_Renderer;

namespace pl::ui {

/// The part of a screen that windows may cover.
struct Screen {
    int width = 0;  ///< in pixels; 0: unknown
    int height = 0;
    float dots_per_inch = 0.0f;  ///< 0: unknown, or the desktop enlarges windows itself
};

/// The usable part of one of several screens.
struct ScreenArea {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
};

/// Smallest window in which all panels can be reached.
inline constexpr int kLeastWindowWidth = 640;
inline constexpr int kLeastWindowHeight = 400;

/// The place itself if its upper edge can be grabbed on one of the screens; else the nearest place inside the screen
/// that it overlaps most, the first one if none. No larger than that screen.
WindowPlace place_on_screens(WindowPlace wanted, std::span<const ScreenArea> screens);

/// The scale grows in halves with the density of the screen, as long as the panels have room; the window is
/// 1440 x 900 times the scale, or as much of it as fits the screen. A requested size is taken as it is.
WindowOptions plan_window(const WindowOptions& options, const Screen& screen);

/// Drawn by the program.
void set_window_icon(SDL_Window* window);

/// Keeps SDL's video subsystem running. Throws Error(Unavailable) with one line on machines without a screen, unless
/// SDL_VIDEODRIVER names a driver that needs none. The check uses the connection that the window uses afterwards: an X
/// server may restart when its last client disconnects, and refuse the next one for a moment.
class VideoSubsystem {
public:
    VideoSubsystem();
    ~VideoSubsystem();
    VideoSubsystem(const VideoSubsystem&) = delete;
    VideoSubsystem& operator=(const VideoSubsystem&) = delete;
};

/// Owner of window and renderer. Chooses an accelerated renderer only if it runs on hardware: SDL's software renderer is
/// several times faster than a software implementation of OpenGL.
class Display {
public:
    /// Throws Error(Unavailable).
    /// Opens at `place`, corrected for the screens of now; in the middle and by `options` without one.
    Display(const std::string& title, const WindowOptions& options, const std::optional<WindowPlace>& place,
            bool software);
    ~Display();
    Display(const Display&) = delete;
    Display& operator=(const Display&) = delete;

    SDL_Window* window() const { return window_; }
    SDL_Renderer* renderer() const { return renderer_; }
    /// "opengl (NVIDIA ...)", "software".
    const std::string& renderer_name() const { return name_; }
    /// Of text and controls, for this screen or as asked for.
    float ui_scale() const { return plan_.ui_scale; }

    void set_title(const std::string& title);
    void toggle_full_screen();
    /// Size, place and scale as by themselves.
    void reset();
    /// Of the window now. In full screen and minimized that is `before`.
    std::optional<WindowPlace> place(const std::optional<WindowPlace>& before) const;
    /// The pixels drawn since the last present; slow.
    ByteImage read_pixels() const;

private:
    bool open(const std::string& title, bool software);
    bool runs_on_hardware();
    void close();

    VideoSubsystem video_;
    WindowOptions plan_;
    std::optional<WindowPlace> place_;
    SDL_Window* window_ = nullptr;
    SDL_Renderer* renderer_ = nullptr;
    std::string name_;
    bool software_ = false;
};

}  // namespace pl::ui
