// Size of the window and scale of its text on a screen.
#pragma once

#include <span>

#include "ui/model/window_place.h"
#include "ui/viewer.h"

namespace pl::ui {

/// The part of a screen that windows may cover.
struct Screen {
    int width = 0;  ///< in pixels; 0: unknown
    int height = 0;
    float dots_per_inch = 0.0f;  ///< 0: unknown, or the desktop enlarges windows itself
};

struct WindowPlan {
    int width;
    int height;
    float ui_scale;
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
WindowPlan plan_window(const WindowOptions& options, const Screen& screen);

}  // namespace pl::ui
