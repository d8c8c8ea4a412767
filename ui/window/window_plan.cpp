#include "ui/window/window_plan.h"

#include <algorithm>
#include <cmath>

namespace pl {
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

}  // namespace

WindowPlan plan_window(const WindowOptions& options, const Screen& screen) {
    const float scale = options.ui_scale > 0.0f ? options.ui_scale : scale_for(screen);
    if (options.width > 0 && options.height > 0) return {options.width, options.height, scale};
    const float title_bar = kTitleBar * scale;
    return {.width = fit(kDesignWidth * scale, static_cast<float>(screen.width)),
            .height = fit(kDesignHeight * scale, static_cast<float>(screen.height) - title_bar),
            .ui_scale = scale};
}

}  // namespace pl
