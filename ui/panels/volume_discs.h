// The discs of the selected volume: the learned radiance, and the light that reaches it on the same scale.
#pragma once

#include "ui/model/viewer_model.h"

namespace pl::ui {

/// Discs in the present CellDisplay; one where nothing true is known of its quantity. The cell under the pointer is marked in all.
void draw_volume_discs(ViewerModel& model, const VolumeInspection& volume);

}  // namespace pl::ui
