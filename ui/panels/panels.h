// The fixed panels around the picture. Each reads the model and calls its commands; none keeps a setting of its own.
#pragma once

#include <optional>

#include "ui/actions.h"
#include "ui/layout.h"
#include "ui/viewer_model.h"

namespace pl {

/// What the pointer is over, for the pixel tab.
struct HoveredPixel {
    int x = 0;  ///< of the picture that is shown
    int y = 0;
};

void draw_menu_bar(ViewerModel& model, const Layout& layout);
void draw_settings_panel(ViewerModel& model, const Layout& layout);
void draw_knowledge_panel(ViewerModel& model, const Layout& layout, const std::optional<HoveredPixel>& hovered);
void draw_accuracy_panel(ViewerModel& model, const Layout& layout);
void draw_status_bar(ViewerModel& model, const Layout& layout);

// Tabs of the right panel.
void draw_volume_tab(ViewerModel& model);
void draw_material_tab(ViewerModel& model);
void draw_effects_tab(ViewerModel& model);
void draw_pixel_tab(ViewerModel& model, const std::optional<HoveredPixel>& hovered);
void draw_statistics_tab(const ViewerModel& model);
void draw_log_tab(const ViewerModel& model);

/// Runs the action of a menu item or a key.
void perform(ViewerModel& model, ActionId action);

/// Starts a window that fills `place` and cannot be moved. End it with ImGui::End().
void begin_fixed_window(const char* name, const Rect& place, int extra_flags = 0);

}  // namespace pl
