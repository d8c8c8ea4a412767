// The panels around and the overlays over the picture.
#pragma once

#include "ui/overlays/overlays.h"
#include "ui/panels/panels.h"

namespace pl::ui {

/// Panels and overlays of a frame of Dear ImGui, the later ones on top. `image` is the rectangle of the picture, `magnifier` null
/// without one.
void draw_interface(ViewerModel& model, const Layout& layout, const Rect& image, const ComparePlan& plan,
                    const std::optional<HoveredPixel>& hovered, const Magnifier* magnifier);

}  // namespace pl::ui
