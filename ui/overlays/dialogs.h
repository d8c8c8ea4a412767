// Dialogs in the middle of the window, over everything else.
#pragma once

#include "ui/draw/layout.h"

namespace pl::ui {

/// Width and height of the whole window, with panels or without.
Vec2f screen_size(const Layout& layout);

/// Starts a dialog that cannot be moved, as high as its content and at most `width` wide; closing it clears `open`. End
/// it with ImGui::End().
void begin_dialog(const char* name, bool& open, const Layout& layout, float width);

}  // namespace pl::ui
