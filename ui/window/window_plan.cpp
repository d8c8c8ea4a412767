#include "ui/window/window_plan.h"

#include <algorithm>
#include <cmath>

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
    return std::clamp(std::floor(2.0f * most) / 2.0f, 1.0f, kMostUiScale);
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

WindowPlan plan_window(const WindowOptions& options, const Screen& screen) {
    const float scale = options.ui_scale > 0.0f ? options.ui_scale : scale_for(screen);
    if (options.width > 0 && options.height > 0) return {options.width, options.height, scale};
    const float title_bar = kTitleBar * scale;
    return {.width = fit(kDesignWidth * scale, static_cast<float>(screen.width)),
            .height = fit(kDesignHeight * scale, static_cast<float>(screen.height) - title_bar),
            .ui_scale = scale};
}

}  // namespace pl::ui
