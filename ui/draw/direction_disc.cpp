#include "ui/draw/direction_disc.h"

#include <algorithm>
#include <cmath>

#include "core/kernel/base/frame.h"
#include "core/kernel/base/warp.h"

namespace pl {
namespace {

/// Corners and edge midpoints of the unit square, counter-clockwise.
constexpr float kBorder[kCellBorderPoints][2] = {{0.0f, 0.0f}, {0.5f, 0.0f}, {1.0f, 0.0f}, {1.0f, 0.5f},
                                                 {1.0f, 1.0f}, {0.5f, 1.0f}, {0.0f, 1.0f}, {0.0f, 0.5f}};

/// Lowest value of a logarithmic scale, relative to the largest.
constexpr float kLogRange = 1.0e-3f;

struct Rgb {
    float r, g, b;
};
constexpr Rgb kViridis[] = {{68, 1, 84},    {72, 40, 120},  {62, 74, 137},  {49, 104, 142}, {38, 130, 142},
                            {31, 158, 137}, {53, 183, 121}, {109, 205, 89}, {180, 222, 44}, {253, 231, 37}};
constexpr int kViridisCount = static_cast<int>(sizeof(kViridis) / sizeof(kViridis[0]));

float value_of(const VolumeInspection& volume, CellQuantity quantity, std::size_t cell) {
    switch (quantity) {
    case CellQuantity::Radiance: return volume.radiance[cell];
    case CellQuantity::Probability: return volume.probability[cell];
    case CellQuantity::Visits: return static_cast<float>(volume.visits[cell]);
    }
    return 0.0f;
}

float position_of(float value, const CellValues& range, ColorScale scale) {
    if (scale == ColorScale::Linear) return std::clamp(value / range.high, 0.0f, 1.0f);
    if (!(value > range.low)) return 0.0f;
    return std::clamp(std::log(value / range.low) / std::log(range.high / range.low), 0.0f, 1.0f);
}

std::uint32_t pack_abgr(Rgb c, std::uint8_t alpha) {
    const auto code = [](float x) { return static_cast<std::uint32_t>(std::lround(std::clamp(x, 0.0f, 255.0f))); };
    return static_cast<std::uint32_t>(alpha) << 24 | code(c.b) << 16 | code(c.g) << 8 | code(c.r);
}

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

CellValues cell_values(const VolumeInspection& volume, CellQuantity quantity, ColorScale scale) {
    CellValues result;
    const auto count = static_cast<std::size_t>(volume.side) * static_cast<std::size_t>(volume.side);
    result.values.reserve(count);
    for (std::size_t cell = 0; cell < count; ++cell) result.values.push_back(value_of(volume, quantity, cell));
    const float largest = count > 0 ? *std::max_element(result.values.begin(), result.values.end()) : 0.0f;
    result.high = largest > 0.0f ? largest : 1.0f;
    result.low = scale == ColorScale::Linear ? 0.0f : result.high * kLogRange;
    result.positions.reserve(count);
    for (const float value : result.values) result.positions.push_back(position_of(value, result, scale));
    return result;
}

float value_at(const CellValues& values, ColorScale scale, float position) {
    if (scale == ColorScale::Linear) return values.low + position * (values.high - values.low);
    return values.low * std::pow(values.high / values.low, position);
}

std::uint32_t map_color(float position, std::uint8_t alpha) {
    const float x = std::clamp(position, 0.0f, 1.0f) * static_cast<float>(kViridisCount - 1);
    const int i = std::min(static_cast<int>(x), kViridisCount - 2);
    const float f = x - static_cast<float>(i);
    const Rgb a = kViridis[i];
    const Rgb b = kViridis[i + 1];
    return pack_abgr({a.r + f * (b.r - a.r), a.g + f * (b.g - a.g), a.b + f * (b.b - a.b)}, alpha);
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

void add_hemisphere(DrawList& list, const VolumeInspection& volume, const std::vector<CellFan>& fans,
                    const CellValues& values, const HemisphereStyle& style) {
    if (fans.size() != values.positions.size()) return;
    const Frame frame = make_frame(volume.normal);
    std::array<Vec3f, std::tuple_size_v<CellFan>> points;
    const auto lift = [&](const CellFan& fan, float scale) {
        for (std::size_t i = 0; i < fan.size(); ++i)
            points[i] = volume.position + scale * style.radius * frame.to_world(lift_to_hemisphere(fan[i]));
    };
    for (std::size_t cell = 0; cell < fans.size(); ++cell) {
        lift(fans[cell], 1.0f);
        list.add_fan(points, map_color(values.positions[cell], style.alpha));
    }
    if (style.highlighted < 0 || static_cast<std::size_t>(style.highlighted) >= fans.size()) return;
    // Slightly outside, so that it is drawn after the cell itself.
    lift(fans[static_cast<std::size_t>(style.highlighted)], 1.01f);
    for (int i = 0; i < kCellBorderPoints; ++i)
        list.add_line(points[static_cast<std::size_t>(1 + i)],
                      points[static_cast<std::size_t>(1 + (i + 1) % kCellBorderPoints)], 0xffffffffu, 2.0f);
}

std::optional<Vec2f> disk_point_of(const VolumeInspection& volume, Vec3f direction) {
    const Vec3f local = make_frame(volume.normal).to_local(direction);
    if (local.z <= 0.0f) return std::nullopt;
    return Vec2f{local.x, local.y};
}

Vec3f direction_of(const VolumeInspection& volume, Vec2f disk) {
    return make_frame(volume.normal).to_world(lift_to_hemisphere(disk));
}

}  // namespace pl
