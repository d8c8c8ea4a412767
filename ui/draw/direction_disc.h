// The cells of a volume's hemisphere as polygons: on the unit disk of their own frame, on which all have the same area, and on
// the hemisphere; their values and colors.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/fields/disc_frame.h"
#include "core/plot/value_scale.h"
#include "core/session/snapshot.h"
#include "ui/draw/draw_list.h"

namespace pl::ui {

/// Center and border of one cell on the unit disk; borders of neighbors share their points exactly.
inline constexpr int kCellBorderPoints = 8;
using CellFan = std::array<Vec2f, 1 + kCellBorderPoints>;

/// One fan per cell, in the order of DirectionCells.
std::vector<CellFan> make_cell_fans(int side);

enum class CellQuantity { Radiance, Probability, Density, Visits };

/// One learned value per cell. Density: of sampling the field, relative to cosine sampling.
std::vector<float> cell_values(const VolumeInspection& volume, CellQuantity quantity);

/// Probabilities of cells as densities relative to cosine sampling, which gives all cells the same.
std::vector<float> relative_to_cosine(std::vector<float> shares);

/// Positions of values in a range, in [0, 1].
std::vector<float> positions_in(const ValueRange& range, std::span<const float> values);

/// heat_color() of a position in [0, 1], as 0xAABBGGRR.
std::uint32_t map_color(float position, std::uint8_t alpha = 255);

/// Statistics of a volume's sampling probabilities.
struct TableSummary {
    std::uint64_t visits = 0;
    int empty_cells = 0;  ///< never visited
    double entropy_bits = 0.0;
    double effective_cells = 0.0;  ///< 2^entropy
    double peak = 0.0;             ///< largest probability over the mean one
};
TableSummary summarize(const VolumeInspection& volume);

/// Direction in scene space above a point of the cells' disk.
Vec3f direction_of(const VolumeInspection& volume, Vec2f disk);

}  // namespace pl::ui
