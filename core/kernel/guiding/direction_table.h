// Sampling a volume's table of directions: a row, a column of it, then a tent around its center; and the density of the result.
#pragma once

#include "core/kernel/guiding/direction_cells.h"

namespace pl {

/// The two columns, or rows, whose centers enclose a coordinate of the unit square, and its interpolation weight: 0 at the
/// first, 1 at the second. Beyond the outermost centers both are the same.
template <class N>
struct CellPair {
    typename N::Int first, second;
    typename N::Real weight;

    PL_INLINE CellPair(const DirectionCells& cells, typename N::Real coordinate) {
        const auto x = coordinate * static_cast<float>(cells.side) - 0.5f;
        const auto below = floor_of<N>(x);
        weight = x - N::to_real(below);
        first = clamp_int<N>(below, 0, cells.side - 1);
        second = clamp_int<N>(below + 1, 0, cells.side - 1);
    }
};

/// Cumulative probabilities of all volumes, and the volume to sample: one, or one per lane.
template <class N>
struct DirectionTables {
    using Int = typename N::Int;
    using Real = typename N::Real;

    DirectionCells cells;
    const float* row_cdf;
    const float* column_cdf;
    Int volume;

    /// Probability of a cell, with the bits by which sample_cell() chooses it: differences of the same stored values.
    PL_INLINE Real cell_probability(Int column, Int row) const {
        return share_of(row_cdf, volume * cells.side, row) * share_of(column_cdf, first_of_row(row), column);
    }
    /// cell_probability() of the four cells whose centers enclose a point. Neighboring cells share a bound, which is loaded once.
    struct FourCells {
        Real low_first, low_second, high_first, high_second;
    };
    PL_INLINE FourCells probabilities(const CellPair<N>& columns, const CellPair<N>& rows) const {
        const Shares row = shares_of(row_cdf, volume * cells.side, rows);
        const Shares low = shares_of(column_cdf, first_of_row(rows.first), columns);
        const Shares high = shares_of(column_cdf, first_of_row(rows.second), columns);
        return {row.first * low.first, row.first * low.second, row.second * high.first, row.second * high.second};
    }
    /// Index of the first cumulative probability of a row.
    PL_INLINE Int first_of_row(Int row) const { return (volume * cells.side + row) * cells.side; }

    /// Where a number lies between the cumulative probabilities of a row, or a column, that enclose it: again uniform in [0, 1], with
    /// log2 of their difference fewer bits. So one number serves twice, and low-discrepancy samples stay well distributed.
    PL_INLINE Real position_in_row(Int row, Real u) const {
        return position_in(row_cdf, volume * cells.side, row, u);
    }
    PL_INLINE Real position_in_column(Int row, Int column, Real u) const {
        return position_in(column_cdf, first_of_row(row), column, u);
    }

private:
    /// Sum of the probabilities before one entry of the distribution that starts at `first`.
    static PL_INLINE Real start_of(const float* cdf, Int first, Int entry) {
        const auto start = N::load(cdf, first + select(entry > 0, entry - 1, entry));
        return select(entry > 0, start, N::constant(0.0f));
    }
    static PL_INLINE Real share_of(const float* cdf, Int first, Int entry) {
        return N::load(cdf, first + entry) - start_of(cdf, first, entry);
    }
    static PL_INLINE Real position_in(const float* cdf, Int first, Int entry, Real u) {
        const Real start = start_of(cdf, first, entry);
        return (u - start) / (N::load(cdf, first + entry) - start);
    }
    struct Shares {
        Real first, second;
    };
    static PL_INLINE Shares shares_of(const float* cdf, Int first, const CellPair<N>& pair) {
        const Real share = share_of(cdf, first, pair.first);
        const Real next = N::load(cdf, first + pair.second) - N::load(cdf, first + pair.first);
        return {share, select(pair.second > pair.first, next, share)};
    }
};

/// The table of one volume.
struct DirectionTable : DirectionTables<One> {
    /// `field` is a TableView or a TableUpdateView.
    template <class Field>
    PL_HD DirectionTable(const Field& field, std::int32_t number)
        : DirectionTables<One>{field.cells, field.row_cdf.data, field.column_cdf.data, number} {}
};

template <class N>
struct CellNumber {
    typename N::Int column, row;
};

/// Samples a row; u in [0,1). Inverts the cumulative distribution: counts the values not above u. The last value is exactly
/// 1, so the search cannot fail.
template <class N>
PL_INLINE typename N::Int sample_row(const DirectionTables<N>& table, typename N::Real u) {
    return N::count_not_above(table.row_cdf, table.volume * table.cells.side, table.cells.side, u);
}

/// Samples a cell of a row in the same way.
template <class N>
PL_INLINE CellNumber<N> sample_cell(const DirectionTables<N>& table, typename N::Int row, typename N::Real u) {
    return {N::count_not_above(table.column_cdf, table.first_of_row(row), table.cells.side, u), row};
}

/// Samples a point of the unit square: a cell by its probability, and a tent around its center that reaches into the neighbors.
/// Density over the square: square_density(). u in [0,1)^2; `row` is sample_row() of u.y.
template <class N>
PL_INLINE Real2<N> sample_square(const DirectionTables<N>& table, typename N::Int row, const Real2<N>& u) {
    const CellNumber<N> cell = sample_cell(table, row, u.x);
    const auto side = static_cast<float>(table.cells.side);
    const auto x = N::to_real(cell.column) + 0.5f + sample_tent<N>(table.position_in_column(row, cell.column, u.x));
    const auto y = N::to_real(row) + 0.5f + sample_tent<N>(table.position_in_row(row, u.y));
    return {reflect_into<N>(x, side) / side, reflect_into<N>(y, side) / side};
}

/// Density of sample_square() over the unit square: bilinear between cell centers, constant beyond the outermost ones. Exact,
/// because the tent is reflected at the border.
template <class N>
PL_INLINE typename N::Real square_density(const DirectionTables<N>& table, const Real2<N>& square) {
    const CellPair<N> x(table.cells, square.x);
    const CellPair<N> y(table.cells, square.y);
    const auto cells = table.probabilities(x, y);
    const auto low = (1.0f - x.weight) * cells.low_first + x.weight * cells.low_second;
    const auto high = (1.0f - x.weight) * cells.high_first + x.weight * cells.high_second;
    return ((1.0f - y.weight) * low + y.weight * high) * static_cast<float>(table.cells.count());
}

template <class N>
struct TableDensity {
    typename N::Real pdf_sa;  ///< per steradian at the volume
    typename N::Int cell;     ///< of the direction; -1 below the volume's horizon
};

/// A direction in coordinates of a volume's table.
template <class N>
struct TableDirection {
    Real2<N> square;            ///< image under the concentric map, [0,1]^2
    typename N::Real cosine;    ///< with the volume's normal
    typename N::Real jacobian;  ///< steradians at the volume per steradian at the served point, see Parallax
};

/// `local` is unit, in the volume's frame.
template <class N>
PL_INLINE TableDirection<N> table_direction(const Real3<N>& local, typename N::Real jacobian) {
    return {disk_to_square(Real2<N>{local.x, local.y}), local.z, jacobian};
}

/// Density of a direction, per steradian at the volume; 0 below its horizon.
template <class N>
PL_INLINE TableDensity<N> table_density(const DirectionTables<N>& table, const TableDirection<N>& direction) {
    const typename N::Mask above = direction.cosine > 0.0f;
    const auto pdf_sa = square_density(table, direction.square) * cosine_pdf_sa<N>(direction.cosine);
    return {select(above, pdf_sa, N::constant(0.0f)),
            select(above, table.cells.cell_of(direction.square), N::constant(-1))};
}

}  // namespace pl
