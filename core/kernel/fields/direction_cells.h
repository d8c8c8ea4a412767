// Directions of a hemisphere as side x side cells of equal projected area: the unit square through the concentric
// map, lifted to the hemisphere. Uniform cells already are cosine sampling, so a table only stores radiance.
#pragma once

#include "core/kernel/base/warp.h"

namespace pl {

/// Most cells to a side.
inline constexpr int kMaxSide = 32;

/// Cell (column, row) of the unit square; index = row * side + column.
struct DirectionCells {
    int side = 16;

    PL_HD int count() const { return side * side; }

    PL_HD int column_of(float x) const { return min_of(static_cast<int>(x * static_cast<float>(side)), side - 1); }

    /// Cell that holds a point of [0,1]^2.
    PL_HD int cell_of(Vec2f square) const { return column_of(square.y) * side + column_of(square.x); }

    /// Cell that holds a unit direction with z >= 0, in the volume's own frame.
    PL_HD int cell_of_direction(Vec3f local) const { return cell_of(cosine_hemisphere_to_square(local)); }

    /// Point of the unit square at (u, v) in [0,1)^2 inside a cell. It keeps so far from the borders that its direction,
    /// taken to the world and back, gives the same cell again.
    PL_HD Vec2f point_in_cell(int cell, Vec2f u) const {
        const float inverse_side = 1.0f / static_cast<float>(side);
        return {(static_cast<float>(cell % side) + clamp_to(u.x, kBorderGap, 1.0f - kBorderGap)) * inverse_side,
                (static_cast<float>(cell / side) + clamp_to(u.y, kBorderGap, 1.0f - kBorderGap)) * inverse_side};
    }

    /// In cells: maps and frames are off by less than 1e-6 of the square, which has at most kMaxSide cells to a side.
    static constexpr float kBorderGap = 0x1p-14f;
};

/// Triangular density on [-1, 1] from a uniform number: one cell width to each side.
PL_HD inline float sample_tent(float u) {
    return u < 0.5f ? std::sqrt(2.0f * u) - 1.0f : 1.0f - std::sqrt(2.0f * (1.0f - u));
}

/// Folds a coordinate that left [0, side] by less than one cell back in, and keeps it below `side`.
PL_HD inline float reflect_into(float x, float side) {
    const float folded = x < 0.0f ? -x : (x > side ? 2.0f * side - x : x);
    return clamp_to(folded, 0.0f, side);
}

}  // namespace pl
