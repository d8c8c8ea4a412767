// The colors of the radiance volumes' cells in the picture of View::Voronoi.
#pragma once

#include <cstdint>

#include "ui/worker/published_frame.h"

namespace pl::ui {

/// `colors` is a frame of View::Voronoi.
CellImage make_cell_image(const DisplayFrame& colors);

/// The color of a volume's cell in such a frame. `codes` are those of ToneCurve::Clamp.
std::uint32_t cell_color(std::int32_t volume, const ToneCodes& codes);

}  // namespace pl::ui
