// The plot of runs as a control: wheel zooms, dragging pans or moves the cursors, double click fits, the legend hides.
#pragma once

#include <functional>

#include "ui/plot/accuracy_model.h"
#include "ui/plot/plot_drag.h"

namespace pl::ui {

/// Fills the width of the window. `drag` is the drag of the pressed button, kept between frames; `frame` is set to the
/// rectangle of the curves. True if a cursor was dragged.
bool draw_accuracy_plot(AccuracyModel& model, PlotDrag& drag, Rect& frame, float height);

/// Names of the runs that `is_shown` selects, with samples of their lines; a click hides or shows a run.
void draw_legend(AccuracyModel& model, const std::function<bool(const PlotLine&)>& is_shown);

}  // namespace pl::ui
