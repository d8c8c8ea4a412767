#include "ui/overlays/dialog.h"

#include <algorithm>

#include "ui/draw/style.h"

namespace pl::ui {

Vec2f screen_size(const Layout& layout) {
    if (!layout.panels) return {layout.view.width, layout.view.height};
    return {layout.menu.width, layout.status.y + layout.status.height};
}

void begin_dialog(const char* name, bool& open, const Layout& layout, float width) {
    const Vec2f screen = screen_size(layout);
    ImGui::SetNextWindowPos({0.5f * screen.x, 0.5f * screen.y}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({std::min(width, screen.x - em(2.0f)), 0.0f});
    ImGui::Begin(name, &open,
                 ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav);
}

}  // namespace pl::ui
