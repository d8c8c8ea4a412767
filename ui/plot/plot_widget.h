// The plot of runs as a control: wheel zooms, dragging pans or moves the cursors, double click fits, the legend hides.
#pragma once

#include <functional>
#include <string>

#include "ui/draw/style.h"
#include "ui/plot/accuracy_model.h"
#include "ui/plot/plot_lines.h"
#include "ui/plot/plot_view.h"
#include "ui/plot/run_lines.h"

namespace pl::ui {

// Draws a plot of runs with Dear ImGui's draw list: ImGui has no plot with logarithmic axes.

struct PlotStyle {
    std::string x_title;
    std::string y_title;
    double slope = -1.0;  ///< of the reference triangle: error of pure noise over cost, in log-log
    double floor = 0.0;   ///< noise of the reference: gray below it; 0: none
};

/// The part of `place` for the curves; the rest is for numbers and titles.
Rect plot_frame(const Rect& place);

/// Background, grid, numbers and titles.
void draw_axes(ImDrawList& list, const PlotView& view, const Rect& frame, const PlotStyle& style);
void draw_lines(ImDrawList& list, std::span<const PlotLine> lines, const PlotView& view, const Rect& frame);
void draw_cursor_line(ImDrawList& list, const Rect& frame, const PlotView& view, const Cursor& cursor);
/// The sample of a line in the legend.
void draw_sample(ImDrawList& list, const PlotLine& line, ImVec2 left, float width);

/// Fills the width of the window. `drag` is the drag of the pressed button, kept between frames; `frame` is set to the
/// rectangle of the curves. True if a cursor was dragged.
bool draw_accuracy_plot(AccuracyModel& model, PlotDrag& drag, Rect& frame, float height);

/// Names of the runs that `is_shown` selects, with samples of their lines; a click hides or shows a run.
void draw_legend(AccuracyModel& model, const std::function<bool(const PlotLine&)>& is_shown);

}  // namespace pl::ui
