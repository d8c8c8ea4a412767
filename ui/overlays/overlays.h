// Overlays over the picture; none is part of the scene.
#pragma once

#include "ui/draw/layout.h"
#include "ui/draw/picture_zoom.h"
#include "ui/model/viewer_model.h"

namespace pl::ui {

// Over a picture in `image`, clipped by the caller.

/// Lobes or domes of the selected and the pinned volumes at their positions, with their peaks and the ray of the hovered cell.
void draw_hemisphere(ViewerModel& model, const Rect& image);

/// Lobes of every n-th volume.
void draw_flowers(ViewerModel& model, const Rect& image);

/// The paths of the clicked pixel as lines.
void draw_path_lines(ViewerModel& model, const Rect& image);

/// A mark for each tile of the picture: whether its method gains or loses there against default.
void draw_gain_marks(const ViewerModel& model, const Rect& image);

/// The values of pixels that are large enough for them, and the border and label of the magnifier.
void draw_pixels(ViewerModel& model, const Layout& layout, const Rect& image, const ComparePlan& plan,
                 const Magnifier* magnifier);

/// Labels of the compared pictures, and the line between two of them, which can be dragged.
void draw_comparison(ViewerModel& model, const ComparePlan& plan);
/// Upper edge of the labels; before there are pictures, of a label over `image`.
float top_of_names(const ComparePlan& plan, const Rect& image);

/// Badges of the picture: method, samples, and everything that could be misread.
void draw_badges(ViewerModel& model, const Layout& layout, const ComparePlan& plan);

/// Toasts, and the speed of the camera after it changed.
void draw_toasts(const ViewerModel& model, const Layout& layout, const ComparePlan& plan);

/// The card of the guided tour, and a frame around the part of the window that its step is about; without the tour what two methods in
/// turns have shown, and the offer of the tour.
void draw_tour(ViewerModel& model, const Layout& layout, const Rect& image, const ComparePlan& plan);

/// The dialog of the self test: a button, and the checks as they finish.
void draw_self_test(ViewerModel& model, const Layout& layout);

/// The dialog that opens scenes: known ones, recent ones, and files.
void draw_open_dialog(ViewerModel& model, const Layout& layout);

/// While the panels are hidden and the pointer moves: the button that shows them.
void draw_show_panels(ViewerModel& model);

/// Name, version and documents.
void draw_about(ViewerModel& model, const Layout& layout);

/// All keys, from the table that dispatches them.
void draw_help(ViewerModel& model, const Layout& layout);

}  // namespace pl::ui
