// The cells of a volume's hemisphere as polygons: on the unit disk, on which all have the same area, and on the
// hemisphere; their values and colors.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/session/snapshot.h"
#include "ui/draw/draw_list.h"

namespace pl {

/// Center and border of one cell on the unit disk; borders of neighbors share their points exactly.
inline constexpr int kCellBorderPoints = 8;
using CellFan = std::array<Vec2f, 1 + kCellBorderPoints>;

/// One fan per cell, in the order of DirectionCells.
std::vector<CellFan> make_cell_fans(int side);

/// Unit direction above a point of the unit disk.
inline Vec3f lift_to_hemisphere(Vec2f disk) {
    return {disk.x, disk.y, safe_sqrt(1.0f - disk.x * disk.x - disk.y * disk.y)};
}

enum class CellQuantity { Radiance, Probability, Visits };
enum class ColorScale { Linear, Logarithmic };

/// Values of all cells, and their positions between the two ends of the legend.
struct CellValues {
    std::vector<float> values;
    std::vector<float> positions;  ///< in [0, 1]; zero values of a logarithmic scale are at 0
    float low = 0.0f;              ///< value at position 0
    float high = 1.0f;             ///< value at position 1
};
CellValues cell_values(const VolumeInspection& volume, CellQuantity quantity, ColorScale scale);

/// The value at a position of the legend.
float value_at(const CellValues& values, ColorScale scale, float position);

/// Color of a position in [0, 1]: dark blue over green to yellow (the viridis map of matplotlib, CC0). 0xAABBGGRR.
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

struct HemisphereStyle {
    float radius = 1.0f;  ///< in scene units
    std::uint8_t alpha = 255;
    int highlighted = -1;  ///< cell, or -1
};
/// The hemisphere as shapes around its volume.
void add_hemisphere(DrawList& list, const VolumeInspection& volume, const std::vector<CellFan>& fans,
                    const CellValues& values, const HemisphereStyle& style);

/// Point of the unit disk for a direction in scene space; empty below the horizon of the volume.
std::optional<Vec2f> disk_point_of(const VolumeInspection& volume, Vec3f direction);
/// Direction in scene space above a point of the unit disk.
Vec3f direction_of(const VolumeInspection& volume, Vec2f disk);

}  // namespace pl
