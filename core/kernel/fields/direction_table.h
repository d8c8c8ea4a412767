// Sampling a volume's directions: a row, a column, then a tent-shaped jitter, with the density that belongs to it.
#pragma once

#include "core/kernel/fields/field_view.h"

namespace pl {

/// Cumulative probabilities of all volumes, and which of them is meant: one, or one for each of several directions.
template <class N>
struct DirectionTables {
    using Int = typename N::Int;
    using Real = typename N::Real;

    DirectionCells cells;
    const float* row_cdf;
    const float* column_cdf;
    Int volume;

    /// Probability of a cell: exactly what sample_cell does, because it is the same stored differences.
    PL_INLINE Real cell_probability(Int column, Int row) const {
        const Int rows = volume * cells.side;
        return share_of(row_cdf, rows, row) * share_of(column_cdf, (rows + row) * cells.side, column);
    }

private:
    /// What one entry adds to the cumulative probabilities that start at `first`.
    static PL_INLINE Real share_of(const float* cdf, Int first, Int entry) {
        const auto start = N::load(cdf, first + select(entry > 0, entry - 1, entry));
        return N::load(cdf, first + entry) - select(entry > 0, start, N::constant(0.0f));
    }
};

/// The table of one volume.
struct DirectionTable : DirectionTables<One> {
    /// Of a FieldView or a FieldPublicationView.
    template <class Field>
    PL_HD DirectionTable(const Field& field, std::int32_t number)
        : DirectionTables<One>{field.cells, field.row_cdf.data, field.column_cdf.data, number} {}
};

template <class N>
struct CellNumber {
    typename N::Int column, row;
};

/// A cell with its table probability; u in [0,1)^2. Chosen is the interval that holds u: as many cumulative values are
/// not above it. The last value is exactly 1, so the search cannot fail.
template <class N>
PL_INLINE CellNumber<N> sample_cell(const DirectionTables<N>& table, const Real2<N>& u) {
    const int side = table.cells.side;
    const auto rows = table.volume * side;
    const auto row = N::count_not_above(table.row_cdf, rows, side, u.y);
    return {N::count_not_above(table.column_cdf, (rows + row) * side, side, u.x), row};
}

/// A point of the unit square: a cell by its probability, jittered by a tent that reaches into the neighbours.
/// Density over the square: square_density().   u, jitter in [0,1)^2
template <class N>
PL_INLINE Real2<N> sample_square(const DirectionTables<N>& table, const Real2<N>& u, const Real2<N>& jitter) {
    const CellNumber<N> cell = sample_cell(table, u);
    const auto side = static_cast<float>(table.cells.side);
    const auto x = N::to_real(cell.column) + 0.5f + sample_tent<N>(jitter.x);
    const auto y = N::to_real(cell.row) + 0.5f + sample_tent<N>(jitter.y);
    return {reflect_into<N>(x, side) / side, reflect_into<N>(y, side) / side};
}

/// Density of sample_square: bilinear between cell centers, constant beyond the outermost ones. Reflecting the tent
/// at the border is what makes this exact.
template <class N>
PL_INLINE typename N::Real square_density(const DirectionTables<N>& table, const Real2<N>& square) {
    const int last = table.cells.side - 1;
    const auto side = static_cast<float>(table.cells.side);
    const auto x = square.x * side - 0.5f;
    const auto y = square.y * side - 0.5f;
    const auto left = floor_of<N>(x);
    const auto below = floor_of<N>(y);
    const auto fx = x - N::to_real(left);
    const auto fy = y - N::to_real(below);
    const auto x0 = clamp_int<N>(left, 0, last);
    const auto y0 = clamp_int<N>(below, 0, last);
    const auto x1 = clamp_int<N>(left + 1, 0, last);
    const auto y1 = clamp_int<N>(below + 1, 0, last);
    const auto low = (1.0f - fx) * table.cell_probability(x0, y0) + fx * table.cell_probability(x1, y0);
    const auto high = (1.0f - fx) * table.cell_probability(x0, y1) + fx * table.cell_probability(x1, y1);
    return ((1.0f - fy) * low + fy * high) * static_cast<float>(table.cells.count());
}

template <class N>
struct TableDensity {
    typename N::Real pdf_sa;  ///< per steradian
    typename N::Int cell;     ///< that holds the direction; -1 below the horizon
};

/// Density of a direction in the volume's frame; none below its horizon.
template <class N>
PL_INLINE TableDensity<N> table_density(const DirectionTables<N>& table, const Real3<N>& local) {
    const typename N::Mask above = local.z > 0.0f;
    const Real2<N> square = disk_to_square(Real2<N>{local.x, local.y});
    const auto pdf_sa = square_density(table, square) * cosine_pdf_sa<N>(local.z);
    return {select(above, pdf_sa, N::constant(0.0f)), select(above, table.cells.cell_of(square), N::constant(-1))};
}

}  // namespace pl
