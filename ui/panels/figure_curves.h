// The figures of the selected volume over the passes, and the past of its field.
#pragma once

#include "ui/model/viewer_model.h"

namespace pl {

/// Divergences of table and paths, and below them the variance factor, over the passes that trained the field.
void draw_figure_curves(const ViewerModel& model);

/// Keeping the past, the slider through it, and the difference of the shown time to now.
void draw_time(ViewerModel& model, const VolumeInspection& shown);

}  // namespace pl
