// Recorded paths as lines over the picture, as data that can be tested without a window.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/diagnose/record_path.h"
#include "core/kernel/scene/scene_view.h"
#include "core/plot/value_scale.h"
#include "ui/draw/draw_list.h"

namespace pl::ui {

/// A straight piece of a path in scene space. Colors are 0xAABBGGRR.
struct PathPiece {
    Vec3f from{0.0f};
    Vec3f to{0.0f};
    std::uint32_t color = 0;
    float width_px = 1.0f;  ///< at the design size of the interface
    bool is_dashed = false;
    bool is_hidden = false;  ///< the scene hides it from the camera
};

struct PathLineStyle {
    ValueRange range{};          ///< of the light that colors stand for, see path_light()
    float escape_length = 1.0f;  ///< of rays that leave the scene, in scene units
    bool has_shadow_rays = false;
    bool is_dashed = false;
    bool is_selected = false;  ///< wider, with a dark casing
};

/// Color of the light that a path brought; gray for none.
std::uint32_t path_color(float light, const ValueRange& range);

/// The path from the camera on, a line for each ray; shadow rays thinner, to visible lights only.
void add_path(std::vector<PathPiece>& pieces, const diagnose::PathRecord& path, const PathLineStyle& style);

/// Rays towards the camera that one call of split_by_visibility() traces at most, but one for each piece.
inline constexpr std::size_t kMostVisibilityRays = 4096;

/// Splits pieces evenly, more finely the fewer there are, and finds which parts the scene hides from `eye`.
std::vector<PathPiece> split_by_visibility(std::span<const PathPiece> pieces, const SceneView& scene, Vec3f eye);

/// A line in the window, in pixels.
struct Stroke {
    Vec2f from{0.0f};
    Vec2f to{0.0f};
    std::uint32_t color = 0;
    float width_px = 1.0f;
};

/// Projected pieces, clipped at the near plane and at the picture; dashes as a stroke each; hidden ones fainter, and first. `scale`:
/// of widths and dashes.
std::vector<Stroke> strokes_of(std::span<const PathPiece> pieces, const Projection& projection, float scale);

}  // namespace pl::ui
