// The plot of runs as files, for slides and for other programs.
#pragma once

#include <string>

#include "ui/plot/accuracy_model.h"

namespace pl::ui {

/// The visible curves on the axes that are shown, with the name of each run.
std::string plot_svg(const AccuracyModel& model);

/// Every point of the runs of this picture: run, samples per pixel, charged seconds, own noise, and relMSE where there is a reference.
std::string plot_csv(const AccuracyModel& model);

}  // namespace pl::ui
