// Distributions of volumes drawn at their positions in the scene, for the window and for pictures without one.
#pragma once

#include <vector>

#include "ui/draw/imgui_draw.h"
#include "ui/draw/lobes.h"
#include "ui/draw/path_lines.h"
#include "ui/model/shown_volumes.h"

namespace pl::ui {

/// Of all lobes, or domes, together: colors by `range`, lengths by density.
struct ShapeScale {
    ValueRange range;
    LobeShape shape = LobeShape::Lobe;
    CellQuantity quantity = CellQuantity::Radiance;
};

/// Share of the scene's diagonal: radius of a dome, and of the ring on the surface.
inline constexpr float kDomeShare = 0.05f;

/// A line in the scene, clipped at the picture.
void draw_scene_line(ImDrawList& out, const Projection& projection, Vec3f from, Vec3f to, ImU32 color, float width);

/// The shapes, farthest first, with ring and peak; hidden parts are faint.
void draw_shapes(ImDrawList& out, const PublishedFrame& frame, const Projection& projection,
                 std::vector<ShownVolume> volumes, const ShapeScale& scale);

/// Paths as lines, with the numbers of one path's vertices; null for none.
void draw_strokes(ImDrawList& out, std::span<const PathPiece> pieces, const Projection& projection,
                  const diagnose::PathRecord* numbered);

void draw_mesh(ImDrawList& out, const ScreenMesh& mesh);

/// A mark for each tile of a picture in `image`, faint where the gains are of an earlier one.
void draw_gain_marks(ImDrawList& out, const TileGains& gains, const Rect& image, bool is_old);

}  // namespace pl::ui
