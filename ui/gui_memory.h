// What the controls of a window share from frame to frame; io.UserData points to it.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "ui/layout.h"

namespace pl {

struct GuiMemory {
    float pointer_rest_seconds = 0.0f;  ///< since it moved: tooltips wait for rest
    /// Where controls were drawn in the last frame, by what is written beside or on them: what scripts point at.
    std::map<std::string, Rect, std::less<>> places;
};

/// Of the window that is there.
GuiMemory& gui_memory();

}  // namespace pl
