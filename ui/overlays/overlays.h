// What is drawn over the picture, and never put into the scene.
#pragma once

#include <span>

#include "ui/layout.h"
#include "ui/style.h"
#include "ui/viewer_model.h"

namespace pl {

/// A polygon seen whole from its first point; without smoothing, so that neighbors meet without a seam.
void fill_fan(ImDrawList& list, std::span<const ImVec2> center_and_border, ImU32 color);

/// Hemisphere of the selected volume where it stands, with the ray of the hovered direction.
void draw_hemisphere(const ViewerModel& model, const Rect& image);

/// Names of the pictures that are compared, and the line between two of them, which can be dragged.
void draw_comparison(ViewerModel& model, const ComparePlan& plan);
/// Where the names begin, from above; below the window without a comparison.
float top_of_names(const ComparePlan& plan);

/// What the picture is: method, samples, and everything about it that could be mistaken.
void draw_badges(ViewerModel& model, const Layout& layout, const ComparePlan& plan);

/// Messages that go away by themselves, and the camera's speed after it changed.
void draw_toasts(const ViewerModel& model, const Layout& layout, const ComparePlan& plan);

/// The self test: a button, and its results as they come.
void draw_self_test(ViewerModel& model, const Layout& layout);

/// All keys, from the table that dispatches them.
void draw_help(ViewerModel& model, const Layout& layout);

}  // namespace pl
