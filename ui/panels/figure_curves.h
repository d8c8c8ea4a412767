// The figures of the selected volume over the passes, and the past of its field.
#pragma once

#include "ui/model/viewer_model.h"

namespace pl::ui {

/// Divergences of table and paths, and below them the variance factor, over the passes that trained the field. `shown`: passes of
/// the time that is shown, 0 for now.
void draw_figures(const std::vector<FigurePoint>& curve, std::uint64_t shown);

/// Those of the selected volume, if there are several.
void draw_figure_curves(const ViewerModel& model);

/// Whether key frames of the field are kept.
void draw_keeping(LearningTime& time);

/// Most memory of the key frames, if they are kept.
void draw_memory(LearningTime& time);

/// The slider through the past, and the difference of the shown time to now; nothing where none is kept.
void draw_time(ViewerModel& model, const VolumeInspection& shown);

}  // namespace pl::ui
