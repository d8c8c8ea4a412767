// What lies over the 8-bit frame that the back end made, on its way into the window.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "ui/worker/published_frame.h"

namespace pl {

/// `colors` is a frame of View::Voronoi.
CellImage make_cell_image(const DisplayFrame& colors);
/// What the cell of a volume looks like there. `codes` are those of ToneCurve::Clamp.
std::uint32_t cell_color(std::int32_t volume, const ToneCodes& codes);

/// What is laid over the picture.
struct CellOverlay {
    const CellImage* cells = nullptr;       ///< ignored if null or of another size than the picture
    float opacity = 0.0f;                   ///< of the cells' colors
    std::optional<std::uint32_t> outlined;  ///< cell_color() of the cell that gets an outline
};

/// Writes ARGB8888 rows, `pitch` pixels apart. Waits for the frame if need be, and throws as DisplayFrame::pixels() does.
void write_picture(const DisplayFrame& frame, const CellOverlay& overlay, std::uint32_t* out, std::size_t pitch);

}  // namespace pl
