// The update of a table in SIMD lanes, bit-identical to the scalar one (core/kernel/guiding/table_update.h), whose order of
// additions it keeps: cells of a row are lanes where they do not depend on each other, rows are lanes where a row is summed
// from cell to cell. Included by one file per instruction set; see lanes.h.
#pragma once

#include "core/kernel/guiding/table_update.h"
#include "cpu/lanes/lane_tiles.h"

namespace pl {
namespace {

/// One table of the given side, a multiple of kLaneWidth; `kSide` is 0 or the side, known to the compiler.
template <std::uint32_t kSide>
class TableInLanes {
public:
    PL_INLINE TableInLanes(const TableUpdateView& field, std::uint32_t volume)
        : field_(field), volume_(volume), first_cell_(static_cast<std::size_t>(volume) * side() * side()) {}

    PL_INLINE void update() {
        absorb_samples();
        weigh_cells();
        build_rows();
        build_row_choice();
    }

private:
    static constexpr std::uint32_t kMostRows = kSide != 0 ? kSide : kMaxSide;
    static constexpr std::uint32_t kMostCells = kMostRows * kMostRows;
    static constexpr std::uint32_t kMostBlocks = kMostRows / kLaneWidth;

    PL_INLINE std::uint32_t side() const {
        return kSide != 0 ? kSide : static_cast<std::uint32_t>(field_.cells.side);
    }

    /// Sums each row, and then the rows in ascending order.
    PL_INLINE void absorb_samples() {
        alignas(64) float radiance[kMostRows], visited[kMostRows], change[kMostRows], changed[kMostRows];
        for (std::uint32_t row = 0; row < side(); row += kLaneWidth) {
            MeanSums<Lanes> sums;
            for (std::uint32_t column = 0; column < side(); column += kLaneWidth) add_tile(row, column, sums);
            store_lanes(sums.radiance, radiance + row);
            store_lanes(sums.visited, visited + row);
            store_lanes(sums.change, change + row);
            store_lanes(sums.changed, changed + row);
        }
        MeanSums<One> sums;
        for (std::uint32_t row = 0; row < side(); ++row)
            sums.add_row({radiance[row], visited[row], change[row], changed[row]});
        mean_radiance_ = sums.mean_radiance();
        field_.mean_radiance.data[volume_] = mean_radiance_;
        if (sums.changed > 0.0f) field_.change.data[volume_] = sums.change / sums.changed;
    }

    /// Absorbs the training samples of a tile of cells and adds its cells to the sums of their rows.
    PL_INLINE void add_tile(std::uint32_t row, std::uint32_t column, MeanSums<Lanes>& sums) {
        LaneTile learned, moved;
        for (std::uint32_t i = 0; i < kLaneWidth; ++i)
            absorb_cells((row + i) * side() + column, learned.rows[i], moved.rows[i]);
        transpose(learned);
        transpose(moved);
        for (std::uint32_t i = 0; i < kLaneWidth; ++i) sums.add_cell(learned.rows[i], moved.rows[i]);
    }

    /// Absorbs the training samples of kLaneWidth cells. Arguments as in MeanSums::add_cell().
    PL_INLINE void absorb_cells(std::uint32_t cell, LaneFloat& learned, LaneFloat& moved) {
        float* radiance = field_.radiance.data + first_cell_ + cell;
        std::uint32_t* visits = field_.visits.data + first_cell_ + cell;
        std::uint32_t* pending_count = field_.pending_count.data + first_cell_ + cell;
        std::int64_t* pending_sum = field_.pending_sum.data + first_cell_ + cell;
        const auto fresh = load_lanes<LaneUint>(pending_count);
        const LaneInt is_fresh = fresh != 0u;
        auto count = load_lanes<LaneUint>(visits);
        auto now = sound_radiance<Lanes>(load_lanes<LaneFloat>(radiance));
        moved = Lanes::constant(kNoChange);
        if (Lanes::any(is_fresh)) {
            const auto mean = mean_of_steps<Lanes>(load_rounded(pending_sum), fresh, field_.radiance_unit);
            const auto next = now + learning_step<Lanes>(count, fresh, field_.rate) * (mean - now);
            moved = select(is_fresh, magnitude(next - now), moved);
            store_lanes(select(is_fresh, next, load_lanes<LaneFloat>(radiance)), radiance);
            now = select(is_fresh, sound_radiance<Lanes>(next), now);
            count = add_visits<Lanes>(count, fresh);
            store_lanes(count, visits);
            store_lanes(LaneUint{}, pending_count);
            clear_where(is_fresh, pending_sum);
        }
        const auto weight = visit_weight<Lanes>(count);
        store_lanes(weight, weight_ + cell);
        store_lanes(weight * now, light_ + cell);
        learned = select(count != 0u, now, Lanes::constant(kUnvisited));
    }

    /// Unnormalized probabilities of the cells into `turned_`, and their sums by row into `row_weight_`.
    PL_INLINE void weigh_cells() {
        for (std::uint32_t row = 0; row < side(); ++row) weigh_row(row);
        for (std::uint32_t row = 0; row < side(); row += kLaneWidth) {
            LaneFloat sum{};
            for (std::uint32_t column = 0; column < side(); column += kLaneWidth) {
                LaneTile tile;
                for (std::uint32_t i = 0; i < kLaneWidth; ++i)
                    tile.rows[i] = load_lanes<LaneFloat>(cdf() + (row + i) * side() + column);
                transpose(tile);
                for (std::uint32_t i = 0; i < kLaneWidth; ++i) {
                    sum += tile.rows[i];
                    store_lanes(tile.rows[i], turned(row, column + i));
                }
            }
            store_lanes(sum, row_weight_ + row);
        }
        total_ = sum_in_order(row_weight_);
    }

    PL_INLINE void weigh_row(std::uint32_t row) {
        const std::uint32_t blocks = side() / kLaneWidth;
        ColumnSums<Lanes> columns[kMostBlocks + 2];  // with an empty block on either side
        columns[0] = columns[blocks + 1] = {LaneFloat{}, LaneFloat{}};
        for (std::uint32_t block = 0; block < blocks; ++block)
            columns[block + 1] = column_sums(row, block * kLaneWidth);
        for (std::uint32_t block = 0; block < blocks; ++block) {
            const ColumnSums<Lanes>* at = columns + block + 1;
            const std::uint32_t cell = row * side() + block * kLaneWidth;
            const ColumnSums<Lanes> left{from_left(at[-1].visits, at[0].visits),
                                         from_left(at[-1].light, at[0].light)};
            const ColumnSums<Lanes> right{from_right(at[0].visits, at[1].visits),
                                          from_right(at[0].light, at[1].light)};
            store_lanes(cell_weight<Lanes>(mean_radiance_, cells_at(cell), left, at[0], right), cdf() + cell);
        }
    }

    /// Sums over the row and its two neighbors, one at the border of the table, for kLaneWidth columns from `column` on.
    PL_INLINE ColumnSums<Lanes> column_sums(std::uint32_t row, std::uint32_t column) const {
        ColumnSums<Lanes> sums{LaneFloat{}, LaneFloat{}};
        const std::uint32_t first = row > 0 ? row - 1 : row;
        const std::uint32_t last = row + 1 < side() ? row + 1 : row;
        for (std::uint32_t i = first; i <= last; ++i) {
            const ColumnSums<Lanes> cells = cells_at(i * side() + column);
            sums.visits += cells.visits;
            sums.light += cells.light;
        }
        return sums;
    }
    PL_INLINE ColumnSums<Lanes> cells_at(std::uint32_t cell) const {
        return {load_lanes<LaneFloat>(weight_ + cell), load_lanes<LaneFloat>(light_ + cell)};
    }

    PL_INLINE void build_rows() {
        const UniformMix mix(field_.uniform_floor, total_, field_.cells.count());
        for (std::uint32_t row = 0; row < side(); row += kLaneWidth) {
            LaneFloat total{};
            for (std::uint32_t column = 0; column < side(); ++column) {
                total += mix.mixed<Lanes>(load_lanes<LaneFloat>(turned(row, column)));
                store_lanes(total, turned(row, column));
            }
            for (std::uint32_t column = 0; column < side(); column += kLaneWidth) {
                LaneTile tile;
                for (std::uint32_t i = 0; i < kLaneWidth; ++i)
                    tile.rows[i] = normalized(load_lanes<LaneFloat>(turned(row, column + i)), total, column + i);
                transpose(tile);
                for (std::uint32_t i = 0; i < kLaneWidth; ++i)
                    store_lanes(tile.rows[i], cdf() + (row + i) * side() + column);
            }
        }
    }

    /// Cumulative probabilities of one column of cells, as accumulate_cdf() makes them of sums.
    PL_INLINE LaneFloat normalized(const LaneFloat& sum, const LaneFloat& total, std::uint32_t column) const {
        if (column + 1 == side()) return Lanes::constant(1.0f);
        const float uniform = static_cast<float>(column + 1) / static_cast<float>(side());
        return select(is_usable_total<Lanes>(total), sum / total, Lanes::constant(uniform));
    }

    PL_INLINE void build_row_choice() {
        const UniformMix mix(field_.uniform_floor, total_, field_.cells.side);
        float total = 0.0f;
        for (std::uint32_t row = 0; row < side(); ++row) {
            total += mix.mixed<One>(row_weight_[row]);
            row_weight_[row] = total;
        }
        float* row_cdf = field_.row_cdf.data + static_cast<std::size_t>(volume_) * side();
        if (is_usable_total<One>(total))
            for (std::uint32_t row = 0; row < side(); row += kLaneWidth)
                store_lanes(load_lanes<LaneFloat>(row_weight_ + row) / total, row_cdf + row);
        else
            for (std::uint32_t row = 0; row < side(); ++row)
                row_cdf[row] = static_cast<float>(row + 1) / static_cast<float>(side());
        row_cdf[side() - 1] = 1.0f;
    }

    PL_INLINE float sum_in_order(const float* rows) const {
        float sum = 0.0f;
        for (std::uint32_t row = 0; row < side(); ++row) sum += rows[row];
        return sum;
    }

    PL_INLINE float* cdf() const { return field_.column_cdf.data + first_cell_; }
    /// One column of kLaneWidth rows.
    PL_INLINE float* turned(std::uint32_t row, std::uint32_t column) {
        return turned_ + (row / kLaneWidth * side() + column) * kLaneWidth;
    }

    const TableUpdateView& field_;
    std::uint32_t volume_;
    std::size_t first_cell_;
    float mean_radiance_ = 0.0f;
    float total_ = 0.0f;
    alignas(64) float row_weight_[kMostRows];
    alignas(64) float weight_[kMostCells], light_[kMostCells];  ///< visits, and learned radiance times these. [cell]
    alignas(64) float turned_[kMostCells];                      ///< [block of rows][column][row in the block]
};

bool update_table(const TableUpdateView& field, std::uint32_t volume) {
    constexpr std::uint32_t kCommonSide = 16;  // the default
    const auto side = static_cast<std::uint32_t>(field.cells.side);
    if (side % kLaneWidth != 0) return false;
    if (side == kCommonSide)
        TableInLanes<kCommonSide>(field, volume).update();
    else
        TableInLanes<0>(field, volume).update();
    return true;
}

bool has_samples(const TableUpdateView& field, std::uint32_t volume) {
    const auto cells = static_cast<std::uint32_t>(field.cells.side * field.cells.side);
    const std::uint32_t* counts = field.pending_count.data + static_cast<std::size_t>(volume) * cells;
    LaneUint found{};
    std::uint32_t cell = 0;
    for (; cell + kLaneWidth <= cells; cell += kLaneWidth) found |= load_lanes<LaneUint>(counts + cell);
    std::uint32_t rest = 0;
    for (; cell < cells; ++cell) rest |= counts[cell];
    return rest != 0 || Lanes::any(found != 0u);
}

}  // namespace
}  // namespace pl
