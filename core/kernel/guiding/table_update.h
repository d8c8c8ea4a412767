// The update of a table: pending sums become learned radiance, and learned radiance becomes cumulative probabilities. Volumes
// are independent of each other and the arithmetic has a fixed order: the same bits on every back end.
#pragma once

#include "core/kernel/guiding/cell_update.h"

namespace pl {

/// All arrays of a table, to be written.
struct TableUpdateView : TableArrays<Span, Span> {
    DirectionCells cells;
    std::uint32_t light_clusters = 0;  ///< of the scene's light tree; 0: no tree
    float radiance_unit = 1.0f;
    float extent = 0.0f;
    LearningRate rate = LearningRate::Forgetful;
    float uniform_floor = kUniformShare;
};

PL_HD inline float learning_step(std::uint32_t visits, std::uint32_t fresh, LearningRate rate) {
    return learning_step<One>(visits, fresh, rate);
}

/// Learned radiance of a cell; 0 for values that no update can produce. `field` is a TableView or a TableUpdateView.
template <class Field>
PL_HD inline float learned_radiance(const Field& field, std::uint32_t cell) {
    return sound_radiance<One>(field.radiance[cell]);
}

/// Sum in ascending order of index.
PL_HD inline float sum_of(const float* values, int count) {
    float total = 0.0f;
    for (int i = 0; i < count; ++i) total += values[i];
    return total;
}

/// Moves the learned radiance of one cell towards the mean of its new training samples and empties the pending sums. Leaves the
/// absolute change of the cell, or kNoChange, in `column_cdf`, which later steps overwrite.
PL_HD inline void absorb_samples(const TableUpdateView& field, std::uint32_t cell) {
    const std::uint32_t fresh = field.pending_count[cell];
    field.column_cdf[cell] = kNoChange;
    if (fresh == 0) return;
    const float mean = from_fixed_point(field.pending_sum[cell], fresh, field.radiance_unit);
    const float step = learning_step(field.visits[cell], fresh, field.rate);
    const float old = learned_radiance(field, cell);
    field.radiance[cell] = old + step * (mean - old);
    field.column_cdf[cell] = std::fabs(field.radiance[cell] - old);
    field.visits[cell] = add_visits<One>(field.visits[cell], fresh);
    field.pending_sum[cell] = 0;
    field.pending_count[cell] = 0;
}

/// Means over a volume after absorb_samples() of its cells: of the learned radiance, with unvisited cells at the mean of the
/// others, and of the change of cells with new training samples.
PL_HD inline void update_means(const TableUpdateView& field, std::uint32_t volume) {
    const auto side = static_cast<std::uint32_t>(field.cells.side);
    MeanSums<One> sums;
    // Row by row, so that the sums of rows do not depend on each other.
    for (std::uint32_t row = volume * side; row < (volume + 1) * side; ++row) {
        MeanSums<One> row_sums;
        for (std::uint32_t cell = row * side; cell < (row + 1) * side; ++cell)
            row_sums.add_cell(field.visits[cell] > 0 ? learned_radiance(field, cell) : kUnvisited,
                              field.column_cdf[cell]);
        sums.add_row(row_sums);
    }
    field.mean_radiance[volume] = sums.mean_radiance();
    if (sums.changed > 0.0f) field.change[volume] = sums.change / sums.changed;
}

/// Visits of one cell as a weight, and its learned radiance times that.
PL_HD inline ColumnSums<One> weighed_cell(const TableUpdateView& field, std::uint32_t cell) {
    const float visits = visit_weight<One>(field.visits[cell]);
    return {visits, visits * learned_radiance(field, cell)};
}

/// Unnormalized probabilities of one row of cells, and their sum. Never fed back into the learned radiance, so smoothing costs
/// variance at most. Rows are numbered through all volumes.
PL_HD inline void weigh_row(const TableUpdateView& field, std::uint32_t row) {
    const int side = field.cells.side;
    const int row_in_volume = static_cast<int>(row) % side;
    const std::uint32_t first = row * static_cast<std::uint32_t>(side);
    const float volume_mean = field.mean_radiance[row / static_cast<std::uint32_t>(side)];
    // Sums over the row and its neighbors, by column, with an empty column on either side.
    ColumnSums<One> columns[kMaxSide + 2];
    const auto add_row = [&](std::uint32_t start) {
        for (int x = 0; x < side; ++x) {
            const ColumnSums<One> cell = weighed_cell(field, start + static_cast<std::uint32_t>(x));
            columns[x + 1].visits += cell.visits;
            columns[x + 1].light += cell.light;
        }
    };
    for (int x = 0; x < side + 2; ++x) columns[x] = {0.0f, 0.0f};
    if (row_in_volume > 0) add_row(first - static_cast<std::uint32_t>(side));
    add_row(first);
    if (row_in_volume + 1 < side) add_row(first + static_cast<std::uint32_t>(side));
    for (int x = 0; x < side; ++x) {
        const std::uint32_t cell = first + static_cast<std::uint32_t>(x);
        field.column_cdf[cell] =
            cell_weight<One>(volume_mean, weighed_cell(field, cell), columns[x], columns[x + 1], columns[x + 2]);
    }
    field.row_cdf[row] = sum_of(field.column_cdf.data + first, side);
}

/// Turns weights into inclusive cumulative probabilities ending in exactly 1. The distribution is uniform if the total is not
/// positive and finite. Returns the total of the weights, or 0.
PL_HD inline float accumulate_cdf(float* weights, int count) {
    float total = 0.0f;
    for (int i = 0; i < count; ++i) {
        total += weights[i];
        weights[i] = total;
    }
    const bool usable = is_usable_total<One>(total);
    for (int i = 0; i < count; ++i)
        weights[i] = usable ? weights[i] / total : static_cast<float>(i + 1) / static_cast<float>(count);
    weights[count - 1] = 1.0f;
    return usable ? total : 0.0f;
}

/// Turns the weights of one row into its cumulative probabilities, with the uniform floor.
PL_HD inline void build_row(const TableUpdateView& field, std::uint32_t row) {
    const auto side = static_cast<std::uint32_t>(field.cells.side);
    const float total = sum_of(field.row_cdf.data + row / side * side, field.cells.side);
    float* weights = field.column_cdf.data + row * side;
    const UniformMix mix(field.uniform_floor, total, field.cells.count());
    for (int i = 0; i < field.cells.side; ++i) weights[i] = mix.mixed<One>(weights[i]);
    accumulate_cdf(weights, field.cells.side);
}

/// Turns the weights of a volume's rows into their cumulative probabilities, with the uniform floor.
PL_HD inline void build_row_choice(const TableUpdateView& field, std::uint32_t volume) {
    const int side = field.cells.side;
    float* rows = field.row_cdf.data + volume * static_cast<std::uint32_t>(side);
    const UniformMix mix(field.uniform_floor, sum_of(rows, side), side);
    for (int i = 0; i < side; ++i) rows[i] = mix.mixed<One>(rows[i]);
    accumulate_cdf(rows, side);
}

}  // namespace pl
