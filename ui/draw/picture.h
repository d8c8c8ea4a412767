// The 8-bit frame of the back end with its overlays, written as the pixels of the window.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "ui/worker/published_frame.h"

namespace pl::ui {

/// Overlay of the radiance volumes' cells.
struct CellOverlay {
    const CellImage* cells = nullptr;       ///< ignored if null or of another size than the picture
    float opacity = 0.0f;                   ///< of the cells' colors
    std::optional<std::uint32_t> outlined;  ///< cell_color() of the cell that gets an outline
    const CellImage* tint = nullptr;        ///< blended in place of the cells' own colors; of the same size
};

/// Writes ARGB8888 rows, `pitch` pixels apart. May wait for the frame, and throws as DisplayFrame::pixels() does.
void write_picture(const DisplayFrame& frame, const CellOverlay& overlay, std::uint32_t* out, std::size_t pitch);

}  // namespace pl::ui
