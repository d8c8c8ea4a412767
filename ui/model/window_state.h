// The look of the window: panels, overlays, scale. Nothing in it reaches the rendering.
#pragma once

#include <optional>

#include "ui/draw/direction_disc.h"
#include "ui/draw/layout.h"
#include "ui/draw/lobes.h"
#include "ui/draw/picture_zoom.h"
#include "ui/draw/theme.h"
#include "ui/plot/plot_view.h"

namespace pl::ui {

// Place of a window on the desktop, and scale of its text.

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

/// The values drawn in the cells of the selected volume's hemisphere.
struct CellDisplay {
    bool truth = true;  ///< the light that reaches the volume, beside the learned one
    CellQuantity quantity = CellQuantity::Radiance;
    RangeRule range;
};

/// The plot of the accuracy panel, between frames.
struct PlotState {
    PlotDrag drag = PlotDrag::None;
    bool has_wheel = false;  ///< the pointer is over it, and the wheel zooms
    Rect frame;              ///< the rectangle of its curves
};

/// In the order of the key.
enum class KeyedPanel { Menu, Settings, Tabs, Accuracy };

/// How much of the settings and displays is shown.
enum class WindowLayout {
    Explore,   ///< the panels that a newcomer needs
    Research,  ///< everything
};

/// Requests of keys and panels to the window itself; the window clears them.
struct WindowRequests {
    bool full_screen = false;
    bool window_shot = false;
    bool view_shot = false;  ///< the picture with everything that is drawn over it
    bool view_copy = false;  ///< the same to the clipboard
    bool paste = false;      ///< what is on the clipboard
    bool quit = false;
    bool reset = false;     ///< everything as at a first start
    bool zoom = false;      ///< 1:1 around the pointer, or the whole picture
    bool fit_size = false;  ///< sets the largest picture that fits into the window
};

struct WindowState {
    WindowLayout layout = WindowLayout::Research;
    PanelChoice panels;
    bool one_side = false;  ///< Layout::one_side of the window now
    bool help = false;
    bool about = false;
    /// The panel that has the keyboard: arrows move between its controls, Enter and Space use them.
    std::optional<KeyedPanel> keyed_panel{};
    bool hemisphere = true;                  ///< of the selected volume and the pinned ones, in the picture
    LobeShape lobe_shape = LobeShape::Lobe;  ///< of that
    bool values_shown = false;               ///< something shows values of the picture
    PictureZoom zoom;                        ///< of the picture
    bool is_dragging = false;                ///< a control is held
    bool magnifier = false;                  ///< beside the pointer
    std::optional<PointedPixel> pointed{};   ///< the pixel under the pointer; empty away from the picture
    float ui_scale = 1.0f;
    Theme theme = Theme::Dark;
    CellDisplay cell_display;
    PlotState plot;
    WindowRequests requests;
};

}  // namespace pl::ui
