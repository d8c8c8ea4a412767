#include "ui/draw/direction_disc.h"

#include <algorithm>
#include <cmath>

#include "core/kernel/base/frame.h"
#include "core/kernel/base/warp.h"
#include "core/kernel/film/heat_color.h"

namespace pl::ui {
namespace {

/// Corners and edge midpoints of the unit square, counter-clockwise.
constexpr float kBorder[kCellBorderPoints][2] = {{0.0f, 0.0f}, {0.5f, 0.0f}, {1.0f, 0.0f}, {1.0f, 0.5f},
                                                 {1.0f, 1.0f}, {0.5f, 1.0f}, {0.0f, 1.0f}, {0.0f, 0.5f}};

}  // namespace

std::vector<CellFan> make_cell_fans(int side) {
    const auto sides = static_cast<float>(side);
    // Not DirectionCells::point_in_cell, which stays inside the borders: neighbors have to share their points.
    const auto point = [&](int cell, float u, float v) {
        return square_to_disk(
            {(static_cast<float>(cell % side) + u) / sides, (static_cast<float>(cell / side) + v) / sides});
    };
    std::vector<CellFan> fans(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
    for (int cell = 0; cell < side * side; ++cell) {
        CellFan& fan = fans[static_cast<std::size_t>(cell)];
        fan[0] = point(cell, 0.5f, 0.5f);
        for (int i = 0; i < kCellBorderPoints; ++i)
            fan[static_cast<std::size_t>(1 + i)] = point(cell, kBorder[i][0], kBorder[i][1]);
    }
    return fans;
}

std::vector<float> cell_values(const VolumeInspection& volume, CellQuantity quantity) {
    switch (quantity) {
    case CellQuantity::Radiance: return volume.radiance;
    case CellQuantity::Probability: return volume.probability;
    case CellQuantity::Density: return relative_to_cosine(cell_shares(volume.side, volume.density));
    case CellQuantity::Visits: return {volume.visits.begin(), volume.visits.end()};
    }
    return {};
}

std::vector<float> relative_to_cosine(std::vector<float> shares) {
    const auto cells = static_cast<float>(shares.size());
    for (float& share : shares) share *= cells;
    return shares;
}

std::vector<float> positions_in(const ValueRange& range, std::span<const float> values) {
    std::vector<float> positions(values.size());
    std::ranges::transform(values, positions.begin(), [&](float value) { return range.position(value); });
    return positions;
}

std::uint32_t map_color(float position, std::uint8_t alpha) {
    const ByteColor color = heat_color(position);
    return static_cast<std::uint32_t>(alpha) << 24 | static_cast<std::uint32_t>(color.b) << 16 |
           static_cast<std::uint32_t>(color.g) << 8 | color.r;
}

TableSummary summarize(const VolumeInspection& volume) {
    TableSummary summary;
    double largest = 0.0;
    for (const float p : volume.probability) {
        if (p > 0.0f) summary.entropy_bits -= static_cast<double>(p) * std::log2(static_cast<double>(p));
        largest = std::max(largest, static_cast<double>(p));
    }
    for (const std::uint32_t visits : volume.visits) {
        summary.visits += visits;
        summary.empty_cells += visits == 0 ? 1 : 0;
    }
    summary.effective_cells = std::exp2(summary.entropy_bits);
    summary.peak = largest * static_cast<double>(volume.probability.size());
    return summary;
}

Vec3f direction_of(const VolumeInspection& volume, Vec2f disk) {
    return make_frame(volume.normal).to_world(lift_to_hemisphere(disk));
}

}  // namespace pl::ui
