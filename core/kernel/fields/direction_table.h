// Sampling a volume's directions: a row, a column, then a tent-shaped jitter, with the density that belongs to it.
#pragma once

#include "core/kernel/fields/table_field.h"

namespace pl {

/// The two columns, or rows, between whose centers a coordinate of the unit square lies, and how far it is from the first
/// to the second. Beyond the outermost ones both are the same.
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
        return share_of(row_cdf, volume * cells.side, row) * share_of(column_cdf, first_of_row(row), column);
    }
    /// The same for the four cells between whose centers a point lies, by fewer loads: of neighbouring entries each
    /// ends where the next one begins.
    struct FourCells {
        Real low_first, low_second, high_first, high_second;
    };
    PL_INLINE FourCells probabilities(const CellPair<N>& columns, const CellPair<N>& rows) const {
        const Shares row = shares_of(row_cdf, volume * cells.side, rows);
        const Shares low = shares_of(column_cdf, first_of_row(rows.first), columns);
        const Shares high = shares_of(column_cdf, first_of_row(rows.second), columns);
        return {row.first * low.first, row.first * low.second, row.second * high.first, row.second * high.second};
    }
    /// Where the cumulative probabilities of a row start.
    PL_INLINE Int first_of_row(Int row) const { return (volume * cells.side + row) * cells.side; }

private:
    /// What one entry adds to the cumulative probabilities that start at `first`.
    static PL_INLINE Real share_of(const float* cdf, Int first, Int entry) {
        const auto start = N::load(cdf, first + select(entry > 0, entry - 1, entry));
        return N::load(cdf, first + entry) - select(entry > 0, start, N::constant(0.0f));
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
    /// Of a TableField or a TableUpdateView.
    template <class Field>
    PL_HD DirectionTable(const Field& field, std::int32_t number)
        : DirectionTables<One>{field.cells, field.row_cdf.data, field.column_cdf.data, number} {}
};

template <class N>
struct CellNumber {
    typename N::Int column, row;
};

/// A row by its probability; u in [0,1). Chosen is the interval that holds u: as many cumulative values are not above it.
/// The last value is exactly 1, so the search cannot fail.
template <class N>
PL_INLINE typename N::Int sample_row(const DirectionTables<N>& table, typename N::Real u) {
    return N::count_not_above(table.row_cdf, table.volume * table.cells.side, table.cells.side, u);
}

/// A cell of a row, in the same way.
template <class N>
PL_INLINE CellNumber<N> sample_cell(const DirectionTables<N>& table, typename N::Int row, typename N::Real u) {
    return {N::count_not_above(table.column_cdf, table.first_of_row(row), table.cells.side, u), row};
}

/// A point of the unit square: a cell by its probability, jittered by a tent that reaches into the neighbours.
/// Density over the square: square_density().   u, jitter in [0,1)^2; `row` is sample_row() of u.y
template <class N>
PL_INLINE Real2<N> sample_square(const DirectionTables<N>& table, typename N::Int row, const Real2<N>& u,
                                 const Real2<N>& jitter) {
    const CellNumber<N> cell = sample_cell(table, row, u.x);
    const auto side = static_cast<float>(table.cells.side);
    const auto x = N::to_real(cell.column) + 0.5f + sample_tent<N>(jitter.x);
    const auto y = N::to_real(cell.row) + 0.5f + sample_tent<N>(jitter.y);
    return {reflect_into<N>(x, side) / side, reflect_into<N>(y, side) / side};
}

/// Density of sample_square: bilinear between cell centers, constant beyond the outermost ones. Reflecting the tent
/// at the border is what makes this exact.
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
    typename N::Real pdf_sa;  ///< per steradian
    typename N::Int cell;     ///< that holds the direction; -1 below the horizon
};

/// A direction in the volume's frame as its table sees it.
template <class N>
struct TableDirection {
    Real2<N> square;
    typename N::Real cosine;  ///< with the volume's normal

    explicit PL_INLINE TableDirection(const Real3<N>& local)
        : square(disk_to_square(Real2<N>{local.x, local.y})), cosine(local.z) {}
    PL_INLINE TableDirection(const Real2<N>& point, typename N::Real cos_theta) : square(point), cosine(cos_theta) {}
};

/// Density of a direction; none below the volume's horizon.
template <class N>
PL_INLINE TableDensity<N> table_density(const DirectionTables<N>& table, const TableDirection<N>& direction) {
    const typename N::Mask above = direction.cosine > 0.0f;
    const auto pdf_sa = square_density(table, direction.square) * cosine_pdf_sa<N>(direction.cosine);
    return {select(above, pdf_sa, N::constant(0.0f)),
            select(above, table.cells.cell_of(direction.square), N::constant(-1))};
}

}  // namespace pl
