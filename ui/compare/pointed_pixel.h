// The pixel under the pointer: of one of the compared pictures, or of the picture.
#pragma once

#include "ui/compare/compare_plan.h"
#include "ui/draw/magnifier.h"

namespace pl::ui {

/// Empty if the pointer is over no picture. `image` is the rectangle of the frame's picture.
std::optional<PointedPixel> pointed_pixel(const ComparePlan& plan, const PublishedFrame& frame, const Rect& image,
                                          Vec2f pointer);

/// The magnifier there, in the same way.
std::optional<Magnifier> magnifier_at(const ComparePlan& plan, const PublishedFrame& frame, const Rect& image,
                                      Vec2f pointer, const Rect& view, float em);

}  // namespace pl::ui
