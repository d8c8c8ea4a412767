// Directions of a hemisphere as side x side cells of equal projected solid angle: the unit square through the concentric map
// (Shirley and Chiu 1997), lifted to the hemisphere. Uniform probabilities are cosine sampling, so a table stores radiance
// without the cosine.
#pragma once

#include "core/kernel/base/warp.h"

namespace pl {

/// Largest number of cells per side.
inline constexpr int kMaxSide = 32;

/// Cell (column, row) of the unit square; index = row * side + column.
struct DirectionCells {
    int side = 16;

    PL_HD int count() const { return side * side; }

    /// Column, or row, of a coordinate of the unit square.
    template <class N>
    PL_INLINE typename N::Int column_of(typename N::Real x) const {
        const auto column = N::truncate(x * static_cast<float>(side));
        return select(column > side - 1, N::constant(side - 1), column);
    }

    /// Cell of a point of [0,1]^2.
    template <class N>
    PL_INLINE typename N::Int cell_of(const Real2<N>& square) const {
        return column_of<N>(square.y) * side + column_of<N>(square.x);
    }
    PL_HD int cell_of(Vec2f square) const { return cell_of(unpack(square)); }

    /// Point of the unit square at u in [0,1)^2 of a cell. Keeps a gap to the cell's borders, so that its direction, transformed
    /// to the world and back, falls into the same cell.
    PL_HD Vec2f point_in_cell(int cell, Vec2f u) const {
        const float inverse_side = 1.0f / static_cast<float>(side);
        return {(static_cast<float>(cell % side) + clamp_to(u.x, kBorderGap, 1.0f - kBorderGap)) * inverse_side,
                (static_cast<float>(cell / side) + clamp_to(u.y, kBorderGap, 1.0f - kBorderGap)) * inverse_side};
    }

    /// In cells: rounding of maps and frames stays below 1e-6 of the square, which has at most kMaxSide cells per side.
    static constexpr float kBorderGap = 0x1p-14f;
};

}  // namespace pl
