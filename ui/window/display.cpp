#include "ui/window/display.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <vector>

#include <fmt/format.h>
#include <SDL.h>

#include "core/base/error.h"
#include "ui/window/offscreen.h"

namespace pl::ui {
namespace {

/// The window at scale 1.
constexpr float kDesignWidth = 1440.0f;
constexpr float kDesignHeight = 900.0f;
/// Least screen per unit of scale: there panels and picture stand side by side.
constexpr float kRoomyWidth = 1280.0f;
constexpr float kRoomyHeight = 720.0f;
/// Height of a title bar at scale 1, which a window's size does not count.
constexpr float kTitleBar = 36.0f;
/// Density that controls of the design size are made for.
constexpr float kDesignDotsPerInch = 96.0f;

float scale_for(const Screen& screen) {
    const auto width = static_cast<float>(screen.width);
    const auto height = static_cast<float>(screen.height);
    const float most =
        std::min({screen.dots_per_inch / kDesignDotsPerInch, width / kRoomyWidth, height / kRoomyHeight});
    constexpr float kSlack = 0.05f;  // screens tell their size in whole millimeters
    return std::clamp(std::floor(2.0f * most + kSlack) / 2.0f, 1.0f, kMostUiScale);
}

int fit(float wanted, float usable) {
    return static_cast<int>(std::round(usable > 0.0f ? std::min(wanted, usable) : wanted));
}

int overlap(int a, int a_size, int b, int b_size) {
    return std::max(std::min(a + a_size, b + b_size) - std::max(a, b), 0);
}

/// Whether the upper edge is on the screen, over a length that a pointer can grab.
bool can_be_grabbed(const WindowPlace& place, const ScreenArea& screen) {
    constexpr int kLeastGrip = 64;
    return place.y >= screen.y && place.y + kLeastGrip <= screen.y + screen.height &&
           overlap(place.x, place.width, screen.x, screen.width) >= kLeastGrip;
}

long long shared_pixels(const WindowPlace& place, const ScreenArea& screen) {
    return static_cast<long long>(overlap(place.x, place.width, screen.x, screen.width)) *
           overlap(place.y, place.height, screen.y, screen.height);
}

}  // namespace

WindowPlace place_on_screens(WindowPlace wanted, std::span<const ScreenArea> screens) {
    wanted.width = std::max(wanted.width, kLeastWindowWidth);
    wanted.height = std::max(wanted.height, kLeastWindowHeight);
    if (screens.empty()) return wanted;
    const ScreenArea& screen =
        *std::ranges::max_element(screens, {}, [&](const ScreenArea& area) { return shared_pixels(wanted, area); });
    wanted.width = std::min(wanted.width, screen.width);
    wanted.height = std::min(wanted.height, screen.height);
    if (can_be_grabbed(wanted, screen)) return wanted;
    wanted.x = std::clamp(wanted.x, screen.x, screen.x + screen.width - wanted.width);
    wanted.y = std::clamp(wanted.y, screen.y, screen.y + screen.height - wanted.height);
    return wanted;
}

WindowOptions plan_window(const WindowOptions& options, const Screen& screen) {
    const float scale = options.ui_scale > 0.0f ? options.ui_scale : scale_for(screen);
    if (options.width > 0 && options.height > 0) return {options.width, options.height, scale};
    const float title_bar = kTitleBar * scale;
    return {.width = fit(kDesignWidth * scale, static_cast<float>(screen.width)),
            .height = fit(kDesignHeight * scale, static_cast<float>(screen.height) - title_bar),
            .ui_scale = scale};
}

namespace {

constexpr int kSize = 64;

/// A box seen from the front: red and green walls, a lamp, and light that fades downwards.
std::uint32_t icon_pixel(int x, int y) {
    constexpr int kInset = 14;
    const int edge = std::min({x, y, kSize - 1 - x, kSize - 1 - y});
    if (edge < 2) return 0xff101216u;
    const bool side = (x < kInset && x <= y && x <= kSize - 1 - y) ||
                      (x >= kSize - kInset && kSize - 1 - x <= y && kSize - 1 - x <= kSize - 1 - y);
    const int light = std::clamp(232 - 2 * y, 60, 255);
    const auto shade = [&](int r, int g, int b) {
        return 0xff000000u | static_cast<std::uint32_t>(r * light / 255) << 16 |
               static_cast<std::uint32_t>(g * light / 255) << 8 | static_cast<std::uint32_t>(b * light / 255);
    };
    if (y >= 5 && y < 10 && x >= 24 && x < 40) return 0xfffff6d8u;
    if (side) return x < kSize / 2 ? shade(220, 48, 40) : shade(64, 178, 72);
    if (x >= 22 && x < 34 && y >= 30 && y < 52) return shade(150, 146, 138);
    if (x >= 36 && x < 46 && y >= 42 && y < 54) return shade(176, 170, 160);
    return shade(232, 226, 214);
}

}  // namespace

void set_window_icon(SDL_Window* window) {
    std::array<std::uint32_t, static_cast<std::size_t>(kSize) * kSize> pixels;
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) pixels[static_cast<std::size_t>(y * kSize + x)] = icon_pixel(x, y);
    SDL_Surface* surface =
        SDL_CreateRGBSurfaceWithFormatFrom(pixels.data(), kSize, kSize, 32, kSize * 4, SDL_PIXELFORMAT_ARGB8888);
    if (surface == nullptr) return;
    SDL_SetWindowIcon(window, surface);
    SDL_FreeSurface(surface);
}

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

/// As the desktop sets it for its own text, else by the size of the screen that the X server tells; 0 if neither is known. SDL asks
/// an extension alone, which some servers and remote desktops lack.
float x11_dots_per_inch() {
    void* const library = SDL_LoadObject("libX11.so.6");  // stays loaded: SDL has it, too
    if (library == nullptr) return 0.0f;
    const auto open = reinterpret_cast<void* (*)(const char*)>(SDL_LoadFunction(library, "XOpenDisplay"));
    const auto close = reinterpret_cast<int (*)(void*)>(SDL_LoadFunction(library, "XCloseDisplay"));
    const auto text =
        reinterpret_cast<char* (*)(void*, const char*, const char*)>(SDL_LoadFunction(library, "XGetDefault"));
    const auto pixels = reinterpret_cast<int (*)(void*, int)>(SDL_LoadFunction(library, "XDisplayHeight"));
    const auto millimeters = reinterpret_cast<int (*)(void*, int)>(SDL_LoadFunction(library, "XDisplayHeightMM"));
    if (!open || !close || !text || !pixels || !millimeters) return 0.0f;
    void* const display = open(nullptr);
    if (display == nullptr) return 0.0f;
    const char* const wanted = text(display, "Xft", "dpi");
    const int height_mm = millimeters(display, 0);
    float density = wanted != nullptr ? std::strtof(wanted, nullptr) : 0.0f;
    constexpr float kMillimetersPerInch = 25.4f;
    if (!(density > 0.0f) && height_mm > 0)
        density = kMillimetersPerInch * static_cast<float>(pixels(display, 0)) / static_cast<float>(height_mm);
    close(display);
    return density;
}

/// The first screen, on which windows open. Drivers that show nothing have none.
Screen first_screen() {
    const char* driver = SDL_GetCurrentVideoDriver();
    SDL_Rect usable{};
    if (shows_nothing(driver) || SDL_GetDisplayUsableBounds(0, &usable) != 0) return {};
    Screen screen{.width = usable.w, .height = usable.h};
    // Wayland and macOS enlarge the window themselves, X11 never does.
    if (std::strcmp(driver, "x11") == 0) screen.dots_per_inch = x11_dots_per_inch();
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
    if (place_ && knows_positions()) {
        // Without the borders of the window manager, which are known once it shows the window: it has placed them, not the pixels inside.
        SDL_PumpEvents();
        SDL_SetWindowPosition(window_, place_->x, place_->y);
    }
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

ByteImage Display::read_pixels() const { return ui::read_pixels(renderer_); }

}  // namespace pl::ui
