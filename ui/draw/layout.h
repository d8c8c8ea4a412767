// The rectangles of panels and picture in the window, recomputed each frame from its size and the font.
#pragma once

#include "ui/draw/draw_list.h"

namespace pl::ui {

/// Panels that are open, and their sizes as the user chose them; a size of 0 is automatic.
struct PanelChoice {
    bool shown = true;              ///< false hides every panel and bar
    bool settings = true;           ///< the panel at the left
    bool right = true;              ///< tabs and accuracy panel
    bool tabs = true;               ///< open in any case without the accuracy panel
    bool accuracy = true;           ///< error against time, below the tabs
    float settings_em = 0.0f;       ///< widths in multiples of the font's height
    float right_em = 0.0f;          ///< in the same way
    float accuracy_share = 0.0f;    ///< of the height at the right, in [0, 1]
    bool prefers_settings = false;  ///< of both sides the one that was opened last, where there is room for one alone

    /// Whether a side is visible, and its opening or folding. `one_side`: see Layout.
    bool shows_settings(bool one_side) const { return settings && !(one_side && right && !prefers_settings); }
    bool shows_right(bool one_side) const { return right && !(one_side && settings && prefers_settings); }
    void toggle_settings(bool one_side) {
        settings = !shows_settings(one_side);
        prefers_settings = settings;
    }
    void toggle_right(bool one_side) {
        right = !shows_right(one_side);
        prefers_settings = !right;
    }

    friend bool operator==(const PanelChoice&, const PanelChoice&) = default;
};

/// Borders that can be dragged.
enum class Border { Settings, Right, Accuracy };

struct Layout {
    Rect menu;
    Rect left;      ///< settings; empty if folded
    Rect right;     ///< tabs: volume, material, effects, pixel, statistics, log; empty if folded
    Rect accuracy;  ///< error against time, below that; empty if folded
    Rect status;
    Rect settings_border;  ///< beside the settings
    Rect right_border;     ///< beside tabs and accuracy panel
    Rect accuracy_border;  ///< between these two; empty if the right side is folded
    Rect view;             ///< available to the picture
    Rect clear;            ///< the part of it that no panel covers
    bool panels = true;
    bool one_side = false;  ///< the window is too narrow for both sides and the picture: one of them is folded
};

/// All in pixels; `em` is the font size. Chosen sizes are limited to those at which no text is cut. In a window too
/// narrow for both sides and the picture one side is folded, and in a very narrow one the other floats over the picture. `detail`: the tabs have more to show, and get more than half
/// of the height beside the accuracy panel unless another share was chosen.
Layout make_layout(float width, float height, float em, const PanelChoice& choice, bool detail);

/// The choice after its border was dragged to the pointer. Neither the picture nor the panel on the other side of the
/// picture becomes too small.
PanelChoice drag_border(PanelChoice choice, Border border, Vec2f pointer, const Layout& layout, float em);

/// The choice with the automatic size of the panel at this border.
PanelChoice free_border(PanelChoice choice, Border border);

/// The largest rectangle with the shape of a picture of width x height in the middle of `view`. A picture that is
/// somewhat smaller than the view is shown pixel by pixel.
Rect place_image(const Rect& view, int width, int height);

/// Size of a picture with the shape of width x height that fills the view pixel by pixel; at least 64 pixels wide.
glm::ivec2 fit_image(const Rect& view, int width, int height);

}  // namespace pl::ui
