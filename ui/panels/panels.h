// The fixed panels around the picture. They show the model and call its objects; none has settings of its own.
#pragma once

#include <optional>

#include "ui/draw/layout.h"
#include "ui/model/viewer_model.h"

namespace pl::ui {

void draw_menu_bar(ViewerModel& model, const Layout& layout);
void draw_settings_panel(ViewerModel& model, const Layout& layout);
void draw_knowledge_panel(ViewerModel& model, const Layout& layout, const std::optional<PixelPosition>& hovered);
void draw_accuracy_panel(ViewerModel& model, const Layout& layout);
void draw_status_bar(ViewerModel& model, const Layout& layout);
/// The borders between panels and picture: dragged they change sizes, their arrows fold the panels.
void draw_borders(ViewerModel& model, const Layout& layout);

/// Whether every setting is shown, or only the settings of a first look.
inline bool is_research(const ViewerModel& model) { return model.window().layout == WindowLayout::Research; }
/// A part of the settings: the learned field, and how it learns.
void draw_learning_section(ViewerModel& model);
/// Bookmarks and the path through them, in the settings.
void draw_cameras(ViewerModel& model);
/// In the settings: the switch of the automatic exposure.
void draw_auto_exposure(ViewerModel& model);
/// The histogram of the picture with marks of the exposure, in the pixel tab.
void draw_histogram(ViewerModel& model);

// Tabs of the right panel.
void draw_volume_tab(ViewerModel& model);
void draw_material_tab(ViewerModel& model);
void draw_effects_tab(const ViewerModel& model);
void draw_pixel_tab(ViewerModel& model, const std::optional<PixelPosition>& hovered);
void draw_statistics_tab(const ViewerModel& model);
void draw_paths_tab(ViewerModel& model);
/// A part of that tab: the noise of its pixel.
void draw_noise_section(PathExplorer& explorer);
void draw_log_tab(const ViewerModel& model);

}  // namespace pl::ui
