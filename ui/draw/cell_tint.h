// The tint by radiance volume in the colors of a value of the volumes, for times that are shown in place of the present.
#pragma once

#include <span>
#include <vector>

#include "ui/worker/field_history.h"
#include "ui/worker/published_frame.h"

namespace pl::ui {

/// Entropy of the sampling probabilities of each volume, as a share of that of a uniform table: 1 is cosine sampling.
std::vector<float> entropy_shares(const FieldKeyFrame& frame);

/// Each pixel in map_color() of its volume's position; pixels of other volumes, or of none, stay as they are. `colors` [volume]: as
/// cell_color() gives them.
CellImage tint_cells(const CellImage& cells, std::span<const std::uint32_t> colors, std::span<const float> positions);

}  // namespace pl::ui
