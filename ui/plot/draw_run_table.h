// The table of runs above the plot, which is its legend too.
#pragma once

#include "ui/plot/accuracy_model.h"

namespace pl::ui {

/// One row for each run of RunTable::rows, with the sample of its line: a click hides or shows the run. Columns in which
/// all runs are on the CPU, or cold, are left out. Below, the table's note.
void draw_run_table(AccuracyModel& model);

/// Older runs of the picture, which have no row, folded away at first. Nothing without any.
void draw_older_runs(AccuracyModel& model);

}  // namespace pl::ui
