// The 8-bit frame of the back end with its overlays, written as the pixels of the window.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/plot/value_scale.h"
#include "ui/worker/field_history.h"
#include "ui/worker/published_frame.h"

namespace pl::ui {

// The tint by radiance volume in the colors of a value of the volumes, for times that are shown in place of the present.

/// Entropy of the sampling probabilities of each volume, as a share of the entropy of a uniform table: 1 is cosine sampling.
std::vector<float> entropy_shares(const FieldKeyFrame& frame);

/// Each pixel in map_color() of its volume's position; pixels of other volumes, or of none, stay as they are. `colors` [volume]: as
/// cell_color() gives them.
CellImage tint_cells(const CellImage& cells, std::span<const std::uint32_t> colors, std::span<const float> positions);

/// Overlay of the radiance volumes' cells.
struct CellOverlay {
    std::shared_ptr<const CellImage> cells;   ///< ignored if null or of another size than the picture
    float opacity = 0.0f;                     ///< of the cells' colors
    std::optional<std::uint32_t> outlined;    ///< cell_color() of the cell that gets an outline
    std::shared_ptr<const CellImage> tint{};  ///< blended in place of the cells' own colors; of the same size

    friend bool operator==(const CellOverlay&, const CellOverlay&) = default;
};

/// The values of a view of numbers in heat_color(), in rows `pitch` pixels apart: the first channel of its pixels.
void write_heat(const Snapshot& snapshot, const ValueRange& range, std::uint32_t* out, std::size_t pitch);

/// Draws the overlay into a picture of width x height pixels, in rows `pitch` pixels apart.
void write_cells(const CellOverlay& overlay, int width, int height, std::uint32_t* out, std::size_t pitch);

/// Writes ARGB8888 rows, `pitch` pixels apart. May wait for the frame, and throws as DisplayFrame::pixels() does.
void write_picture(const DisplayFrame& frame, const CellOverlay& overlay, std::uint32_t* out, std::size_t pitch);

}  // namespace pl::ui
