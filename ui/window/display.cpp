#include "ui/window/display.h"

#include <cstdlib>
#include <cstring>
#include <vector>

#include <fmt/format.h>
#include <SDL.h>

#include "core/base/error.h"
#include "ui/window/icon.h"
#include "ui/window/offscreen.h"

namespace pl::ui {
namespace {

bool is_set(const char* variable) {
    const char* value = std::getenv(variable);
    return value != nullptr && *value != '\0';
}

bool shows_nothing(const char* driver) {
    return std::strcmp(driver, "offscreen") == 0 || std::strcmp(driver, "dummy") == 0;
}

/// GL_RENDERER of the context that SDL's renderer uses; empty if it uses none.
std::string opengl_device() {
    using GetString = const unsigned char*(SDLCALL*)(unsigned int);
    constexpr unsigned int kGlRenderer = 0x1F01;
    if (SDL_GL_GetCurrentContext() == nullptr) return "";
    auto get_string = reinterpret_cast<GetString>(SDL_GL_GetProcAddress("glGetString"));
    if (get_string == nullptr) return "";
    const unsigned char* text = get_string(kGlRenderer);
    return text != nullptr ? reinterpret_cast<const char*>(text) : "";
}

/// The first screen, on which windows open. Drivers that show nothing have none.
Screen first_screen() {
    const char* driver = SDL_GetCurrentVideoDriver();
    SDL_Rect usable{};
    if (shows_nothing(driver) || SDL_GetDisplayUsableBounds(0, &usable) != 0) return {};
    Screen screen{.width = usable.w, .height = usable.h};
    // Wayland and macOS enlarge the window themselves, X11 never does.
    if (std::strcmp(driver, "x11") == 0) SDL_GetDisplayDPI(0, nullptr, &screen.dots_per_inch, nullptr);
    return screen;
}

std::vector<ScreenArea> all_screens() {
    std::vector<ScreenArea> screens;
    if (shows_nothing(SDL_GetCurrentVideoDriver())) return screens;
    for (int i = 0; i < SDL_GetNumVideoDisplays(); ++i) {
        SDL_Rect usable{};
        if (SDL_GetDisplayUsableBounds(i, &usable) == 0) screens.push_back({usable.x, usable.y, usable.w, usable.h});
    }
    return screens;
}

/// Wayland tells no window where it is.
bool knows_positions() { return std::strcmp(SDL_GetCurrentVideoDriver(), "wayland") != 0; }

}  // namespace

VideoSubsystem::VideoSubsystem() {
    const bool chosen = is_set("SDL_VIDEODRIVER");
    // Checked before SDL opens a window that nobody can see.
    if (!chosen && !is_set("DISPLAY") && !is_set("WAYLAND_DISPLAY"))
        throw Error(ErrorKind::Unavailable, "no display: neither DISPLAY nor WAYLAND_DISPLAY is set");
    SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");  // the program has its own
    if (SDL_InitSubSystem(SDL_INIT_VIDEO) != 0)
        throw Error(ErrorKind::Unavailable, fmt::format("no display: {}", SDL_GetError()));
    if (chosen || !shows_nothing(SDL_GetCurrentVideoDriver())) return;
    SDL_QuitSubSystem(SDL_INIT_VIDEO);
    throw Error(ErrorKind::Unavailable,
                fmt::format("no display: '{}' cannot be opened",
                            is_set("DISPLAY") ? std::getenv("DISPLAY") : std::getenv("WAYLAND_DISPLAY")));
}

VideoSubsystem::~VideoSubsystem() { SDL_QuitSubSystem(SDL_INIT_VIDEO); }

Display::Display(const std::string& title, const WindowOptions& options, const std::optional<WindowPlace>& place,
                 bool software)
    : plan_(plan_window(options, first_screen())) {
    if (place) {
        place_ = place_on_screens(*place, all_screens());
        plan_.width = place_->width;
        plan_.height = place_->height;
    }
    // A driver or renderer named in the environment has priority.
    const bool probe = !software && !is_set("SDL_RENDER_DRIVER") && !is_set("SDL_FRAMEBUFFER_ACCELERATION") &&
                       !shows_nothing(SDL_GetCurrentVideoDriver());
    bool opened = false;
    if (probe || (!software && is_set("SDL_RENDER_DRIVER"))) {
        opened = open(title, false);
        if (opened && probe && !runs_on_hardware()) opened = false;
    }
    if (!opened) {
        SDL_SetHint(SDL_HINT_FRAMEBUFFER_ACCELERATION, "0");
        opened = open(title, true);
    }
    if (!opened) {
        // Wayland has no window surface of plain pixels.
        SDL_SetHint(SDL_HINT_FRAMEBUFFER_ACCELERATION, "1");
        opened = open(title, true);
    }
    if (!opened) throw Error(ErrorKind::Unavailable, fmt::format("cannot open a window: {}", SDL_GetError()));
    SDL_SetWindowMinimumSize(window_, kLeastWindowWidth, kLeastWindowHeight);
    if (place_ && place_->maximized) SDL_MaximizeWindow(window_);
    set_window_icon(window_);
}

Display::~Display() { close(); }

bool Display::open(const std::string& title, bool software) {
    close();
    constexpr int kAnywhere = static_cast<int>(SDL_WINDOWPOS_CENTERED_MASK);
    const bool is_placed = place_ && knows_positions();
    window_ = SDL_CreateWindow(title.c_str(), is_placed ? place_->x : kAnywhere, is_placed ? place_->y : kAnywhere,
                               plan_.width, plan_.height, SDL_WINDOW_RESIZABLE);
    if (window_ == nullptr) return false;
    const auto flags =
        static_cast<Uint32>(software ? SDL_RENDERER_SOFTWARE : SDL_RENDERER_ACCELERATED | SDL_RENDERER_PRESENTVSYNC);
    renderer_ = SDL_CreateRenderer(window_, -1, flags);
    if (renderer_ == nullptr) return false;
    SDL_RendererInfo info{};
    SDL_GetRendererInfo(renderer_, &info);
    software_ = (info.flags & SDL_RENDERER_SOFTWARE) != 0;
    name_ = info.name != nullptr ? info.name : "";
    if (const std::string device = software_ ? "" : opengl_device(); !device.empty()) name_ += " (" + device + ")";
    return true;
}

bool Display::runs_on_hardware() {
    if (software_) return false;
    return name_.find("llvmpipe") == std::string::npos && name_.find("softpipe") == std::string::npos &&
           name_.find("SWR") == std::string::npos;
}

void Display::close() {
    if (renderer_ != nullptr) SDL_DestroyRenderer(renderer_);
    if (window_ != nullptr) SDL_DestroyWindow(window_);
    renderer_ = nullptr;
    window_ = nullptr;
}

void Display::set_title(const std::string& title) { SDL_SetWindowTitle(window_, title.c_str()); }

void Display::toggle_full_screen() {
    const bool is_full = (SDL_GetWindowFlags(window_) & SDL_WINDOW_FULLSCREEN_DESKTOP) != 0;
    SDL_SetWindowFullscreen(window_, is_full ? 0u : static_cast<Uint32>(SDL_WINDOW_FULLSCREEN_DESKTOP));
}

void Display::reset() {
    SDL_SetWindowFullscreen(window_, 0);
    SDL_RestoreWindow(window_);
    plan_ = plan_window({}, first_screen());
    SDL_SetWindowSize(window_, plan_.width, plan_.height);
    constexpr int kCentered = static_cast<int>(SDL_WINDOWPOS_CENTERED_MASK);
    SDL_SetWindowPosition(window_, kCentered, kCentered);
}

std::optional<WindowPlace> Display::place(const std::optional<WindowPlace>& before) const {
    const Uint32 flags = SDL_GetWindowFlags(window_);
    if ((flags & (SDL_WINDOW_FULLSCREEN | SDL_WINDOW_MINIMIZED)) != 0) return before;
    WindowPlace now;
    SDL_GetWindowPosition(window_, &now.x, &now.y);
    SDL_GetWindowSize(window_, &now.width, &now.height);
    if ((flags & SDL_WINDOW_MAXIMIZED) == 0) return now;
    if (before) now = *before;
    now.maximized = true;
    return now;
}

ScreenPixels Display::read_pixels() const { return ui::read_pixels(renderer_); }

}  // namespace pl::ui
