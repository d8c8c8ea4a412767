// The plot of runs as a control: wheel zooms, dragging pans or moves the cursors, double click fits, the legend hides.
#pragma once

#include "ui/accuracy/accuracy_model.h"
#include "ui/plot/plot_drag.h"

namespace pl {

/// Fills the width of the window. `drag` is what the pressed button holds, kept between frames; `frame` is set to where
/// the curves are. True if a cursor was moved by hand.
bool draw_accuracy_plot(AccuracyModel& model, PlotDrag& drag, Rect& frame, float height);

/// Names of all runs with a sample of their lines; a click hides or shows one.
void draw_legend(AccuracyModel& model);

}  // namespace pl
