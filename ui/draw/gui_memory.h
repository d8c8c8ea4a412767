// State that the controls of a window share from frame to frame; io.UserData points to it.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "ui/draw/layout.h"

namespace pl::ui {

class PictureTextures;

struct GuiMemory {
    PictureTextures* textures = nullptr;  ///< of the window's renderer
    float pointer_rest_seconds = 0.0f;    ///< since the pointer moved: tooltips wait for rest
    float card_top = 0.0f;                ///< upper edge of the tour's card in the last frame
    /// Rectangles of the controls in the last frame by their labels: scripts point at them.
    std::map<std::string, Rect, std::less<>> places;
};

/// A context of Dear ImGui that keeps no files: the layout follows from the window's size. `memory` outlives it.
void create_gui_context(GuiMemory& memory);

/// Of the present ImGui context.
GuiMemory& gui_memory();

}  // namespace pl::ui
