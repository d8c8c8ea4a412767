// Sampling a volume's directions: a row, a column, then a tent-shaped jitter, with the density that belongs to it.
#pragma once

#include "core/kernel/fields/field_view.h"

namespace pl {

/// Cumulative probabilities of one volume.
struct DirectionTable {
    DirectionCells cells;
    const float* row_cdf;
    const float* column_cdf;

    /// Of a FieldView or a FieldPublicationView.
    template <class Field>
    PL_HD DirectionTable(const Field& field, std::int32_t volume)
        : cells(field.cells), row_cdf(field.row_cdf.data + volume * field.cells.side),
          column_cdf(field.column_cdf.data + volume * field.cells.count()) {}

    /// Probability of a cell: exactly what sample_cell does, because it is the same stored differences.
    PL_HD float cell_probability(int column, int row) const {
        const float row_start = row > 0 ? row_cdf[row - 1] : 0.0f;
        const float* columns = column_cdf + row * cells.side;
        const float column_start = column > 0 ? columns[column - 1] : 0.0f;
        return (row_cdf[row] - row_start) * (columns[column] - column_start);
    }
};

/// Index of the interval that holds u in [0,1): the number of cumulative values not above u. The last value is
/// exactly 1, so the search cannot fail.
PL_HD inline int find_interval(const float* cdf, int count, float u) {
    int index = 0;
    for (int i = 0; i < count - 1; ++i) index += cdf[i] <= u ? 1 : 0;
    return index;
}

/// A cell with its table probability; u in [0,1)^2.
PL_HD inline int sample_cell(const DirectionTable& table, Vec2f u) {
    const int side = table.cells.side;
    const int row = find_interval(table.row_cdf, side, u.y);
    return row * side + find_interval(table.column_cdf + row * side, side, u.x);
}

/// A point of the unit square: a cell by its probability, jittered by a tent that reaches into the neighbours.
/// Density over the square: square_density().   u, jitter in [0,1)^2
PL_HD inline Vec2f sample_square(const DirectionTable& table, Vec2f u, Vec2f jitter) {
    const int cell = sample_cell(table, u);
    const auto side = static_cast<float>(table.cells.side);
    const float x = static_cast<float>(cell % table.cells.side) + 0.5f + sample_tent(jitter.x);
    const float y = static_cast<float>(cell / table.cells.side) + 0.5f + sample_tent(jitter.y);
    return {reflect_into(x, side) / side, reflect_into(y, side) / side};
}

/// Density of sample_square: bilinear between cell centers, constant beyond the outermost ones. Reflecting the tent
/// at the border is what makes this exact.
PL_HD inline float square_density(const DirectionTable& table, Vec2f square) {
    const int side = table.cells.side;
    const float x = square.x * static_cast<float>(side) - 0.5f;
    const float y = square.y * static_cast<float>(side) - 0.5f;
    const float floor_x = std::floor(x);
    const float floor_y = std::floor(y);
    const float fx = x - floor_x;
    const float fy = y - floor_y;
    const int x0 = clamp_to(static_cast<int>(floor_x), 0, side - 1);
    const int y0 = clamp_to(static_cast<int>(floor_y), 0, side - 1);
    const int x1 = clamp_to(static_cast<int>(floor_x) + 1, 0, side - 1);
    const int y1 = clamp_to(static_cast<int>(floor_y) + 1, 0, side - 1);
    const float low = (1.0f - fx) * table.cell_probability(x0, y0) + fx * table.cell_probability(x1, y0);
    const float high = (1.0f - fx) * table.cell_probability(x0, y1) + fx * table.cell_probability(x1, y1);
    return ((1.0f - fy) * low + fy * high) * static_cast<float>(table.cells.count());
}

struct TableDensity {
    float pdf_sa = 0.0f;     ///< per steradian
    std::int32_t cell = -1;  ///< that holds the direction
};

/// Density of a direction in the volume's frame; none below its horizon.
PL_HD inline TableDensity table_density(const DirectionTable& table, Vec3f local) {
    if (!(local.z > 0.0f)) return {};
    const Vec2f square = cosine_hemisphere_to_square(local);
    return {square_density(table, square) * cosine_hemisphere_pdf_sa(local.z), table.cells.cell_of(square)};
}

}  // namespace pl
