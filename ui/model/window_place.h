// Place of a window on the desktop, and scale of its text.
#pragma once

namespace pl::ui {

/// In the desktop's coordinates.
struct WindowPlace {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
    bool maximized = false;  ///< the others are those before

    friend bool operator==(const WindowPlace&, const WindowPlace&) = default;
};

/// Smallest and largest scale of text and controls.
inline constexpr float kLeastUiScale = 0.75f;
inline constexpr float kMostUiScale = 2.0f;

}  // namespace pl::ui
