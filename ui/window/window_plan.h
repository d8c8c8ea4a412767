// Size of the window and scale of its text on a screen.
#pragma once

#include "ui/viewer.h"

namespace pl {

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

/// Largest scale of text and controls.
inline constexpr float kMostUiScale = 2.0f;

/// The scale grows in halves with the density of the screen, as long as the panels have room; the window is
/// 1440 x 900 times the scale, or as much of it as fits the screen. What was asked for is taken as it is.
WindowPlan plan_window(const WindowOptions& options, const Screen& screen);

}  // namespace pl
