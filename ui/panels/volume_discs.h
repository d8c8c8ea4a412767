// The discs of the selected volume: the learned radiance, and the light that reaches it on the same scale.
#pragma once

#include <optional>
#include <vector>

#include "ui/draw/direction_disc.h"
#include "ui/draw/widgets.h"
#include "ui/model/viewer_model.h"

namespace pl::ui {

// The disc of a hemisphere as a widget: cells in the colors of the map, marks of its frame, legend, cursor.

/// The unit disk in the window: x to the right, y up.
struct DiscPlace {
    ImVec2 center;
    float radius;

    ImVec2 operator()(Vec2f disc) const { return {center.x + radius * disc.x, center.y - radius * disc.y}; }
    Vec2f inverse(ImVec2 window) const { return {(window.x - center.x) / radius, (center.y - window.y) / radius}; }
};

/// The part that all discs of one volume share.
struct DiscShape {
    DiscFrame frame;
    std::vector<CellFan> fans;
    Vec3f to_camera;  ///< unit

    DiscShape(const VolumeInspection& volume, const CameraDescription& camera);
};

/// Draws cells by their positions in the map, the rim, a cross at the normal and a ring at the direction towards the camera; up is
/// labeled. `highlighted`: cell with a white border, or -1.
void draw_disc(ImDrawList& list, const DiscPlace& place, const DiscShape& shape, std::span<const float> positions,
               int highlighted);

/// The cell at a point of the window, or -1 outside of the disc.
int cell_at(const DiscPlace& place, const DiscShape& shape, int side, ImVec2 window);

/// Width of a legend, in multiples of the font's height.
inline constexpr float kLegendEm = 5.2f;
/// Colors of a range from bottom to top, with values of three digits, in a rectangle kLegendEm wide.
void draw_legend(ImDrawList& list, const Rect& place, const ValueRange& range);

/// Discs in the present CellDisplay; one where nothing true is known of its quantity. The cell under the pointer is marked in all.
void draw_volume_discs(ViewerModel& model, const VolumeInspection& volume);

}  // namespace pl::ui
