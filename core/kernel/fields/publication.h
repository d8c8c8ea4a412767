// Between passes: what the pass recorded becomes the table of the next one. One volume at a time, each independent
// of the others, plain arithmetic in a fixed order: the same bits on every back end.
#pragma once

#include "core/kernel/fields/field_view.h"

namespace pl {

/// How fast old targets are forgotten. With N records in a cell and m new ones the old mean keeps the share
/// (N/(N+m))^p. p = 1 is the learning rate 1/(1+visits) of Dahm and Keller 2017; a larger p forgets the early
/// targets, which came from tables that knew little, and still averages the noise of the later ones.
enum class LearningRate : std::uint32_t {
    SampleMean = 1,  ///< 1/(1+visits)
    Forgetful = 4,   ///< p = 4
};

/// Everything publication writes, one row per volume.
struct FieldPublicationView {
    DirectionCells cells;
    float radiance_unit = 1.0f;
    LearningRate rate = LearningRate::Forgetful;
    float uniform_floor = 0.05f;  ///< share of the table that is uniform, so that no cell is ever impossible

    Span<float> radiance;               ///< learned incident radiance Q. [volume][cell]
    Span<std::uint32_t> visits;         ///< records so far. [volume][cell]
    Span<std::int64_t> pending_sum;     ///< emptied. [volume][cell]
    Span<std::uint32_t> pending_count;  ///< emptied. [volume][cell]
    Span<float> row_cdf;                ///< [volume][row]
    Span<float> column_cdf;             ///< [volume][row][column]
    Span<float> mean_radiance;          ///< [volume]
};

/// Share of the new mean that `fresh` new records get: 1 - (N/(N+m))^p. Written in terms of m/(N+m), because the
/// difference from 1 would lose every digit after ten million visits.
PL_HD inline float learning_step(std::uint32_t visits, std::uint32_t fresh, LearningRate rate) {
    const auto m = static_cast<float>(fresh);
    const float share = m / (static_cast<float>(visits) + m);
    if (rate == LearningRate::SampleMean) return share;
    // 1 - (1-s)^4; rounding must not carry the mean past its targets.
    return min_of(share * (4.0f + share * (-6.0f + share * (4.0f - share))), 1.0f);
}

/// What a cell has learned, or 0 where memory holds what no record could have put there: NaN, infinite, negative.
PL_HD inline float learned_radiance(const FieldPublicationView& field, std::uint32_t cell) {
    const float radiance = field.radiance[cell];
    return radiance > 0.0f && radiance < kInfinity ? radiance : 0.0f;
}

/// Moves the learned radiance of one cell towards the mean of its new records and empties the sums.
PL_HD inline void absorb_records(const FieldPublicationView& field, std::uint32_t cell) {
    const std::uint32_t fresh = field.pending_count[cell];
    if (fresh == 0) return;
    const float mean = from_fixed_point(field.pending_sum[cell], fresh, field.radiance_unit);
    const float step = learning_step(field.visits[cell], fresh, field.rate);
    const float old = learned_radiance(field, cell);
    field.radiance[cell] = old + step * (mean - old);
    const std::uint32_t room = 0xffffffffu - field.visits[cell];
    field.visits[cell] += min_of(fresh, room);
    field.pending_sum[cell] = 0;
    field.pending_count[cell] = 0;
}

/// Radiance that a cell is sampled by: with few visits it leans on the visit-weighted mean of its 3 x 3 neighbours,
/// and that mean on the volume's. Never fed back into what is learned, so it can cost noise but not bias.
PL_HD inline float smoothed_radiance(const FieldPublicationView& field, std::uint32_t first, int column, int row,
                                     float volume_mean) {
    constexpr float kPriorVisits = 2.0f;
    const int side = field.cells.side;
    float sum = kPriorVisits * volume_mean;
    float weight = kPriorVisits;
    for (int y = max_of(row - 1, 0); y <= min_of(row + 1, side - 1); ++y)
        for (int x = max_of(column - 1, 0); x <= min_of(column + 1, side - 1); ++x) {
            const std::uint32_t cell = first + static_cast<std::uint32_t>(y * side + x);
            const float visits = min_of(static_cast<float>(field.visits[cell]), 1.0e6f);
            sum += visits * learned_radiance(field, cell);
            weight += visits;
        }
    const std::uint32_t own = first + static_cast<std::uint32_t>(row * side + column);
    const float visits = min_of(static_cast<float>(field.visits[own]), 1.0e6f);
    return (visits * learned_radiance(field, own) + kPriorVisits * (sum / weight)) / (visits + kPriorVisits);
}

/// Mean of the learned radiance over the cells; those never visited count as the mean of the others.
PL_HD inline float mean_of_visited(const FieldPublicationView& field, std::uint32_t first) {
    float sum = 0.0f;
    std::uint32_t visited = 0;
    for (int k = 0; k < field.cells.count(); ++k) {
        const std::uint32_t cell = first + static_cast<std::uint32_t>(k);
        if (field.visits[cell] == 0) continue;
        sum += learned_radiance(field, cell);
        ++visited;
    }
    return visited > 0 ? sum / static_cast<float>(visited) : 0.0f;
}

/// Turns weights into inclusive cumulative probabilities ending in exactly 1. A total that is not positive and
/// finite gives the uniform distribution. Returns the total of the weights.
PL_HD inline float accumulate_cdf(float* weights, int count) {
    float total = 0.0f;
    for (int i = 0; i < count; ++i) {
        total += weights[i];
        weights[i] = total;
    }
    const bool usable = total > 0.0f && total < kInfinity;
    for (int i = 0; i < count; ++i)
        weights[i] = usable ? weights[i] / total : static_cast<float>(i + 1) / static_cast<float>(count);
    weights[count - 1] = 1.0f;
    return usable ? total : 0.0f;
}

/// Sum in order of number.
PL_HD inline float sum_of(const float* values, int count) {
    float total = 0.0f;
    for (int i = 0; i < count; ++i) total += values[i];
    return total;
}

/// Share of `weight` in `total`, mixed with an equal share of `count`; equal shares alone if the total is unusable.
PL_HD inline float with_uniform_share(const FieldPublicationView& field, float weight, float total, int count) {
    const float uniform = 1.0f / static_cast<float>(count);
    const bool known = total > 0.0f && total < kInfinity;
    return (1.0f - field.uniform_floor) * (known ? weight / total : uniform) + field.uniform_floor * uniform;
}

/// Weight of every cell before anything is normalized: what the cell is thought to receive.
PL_HD inline void weigh_cell(const FieldPublicationView& field, std::uint32_t cell) {
    const auto cells = static_cast<std::uint32_t>(field.cells.count());
    const std::uint32_t volume = cell / cells;
    const auto inside = static_cast<int>(cell % cells);
    field.column_cdf[cell] = smoothed_radiance(field, volume * cells, inside % field.cells.side,
                                               inside / field.cells.side, field.mean_radiance[volume]);
}

/// Total weight of one row of cells; rows are numbered through all volumes.
PL_HD inline void sum_row(const FieldPublicationView& field, std::uint32_t row) {
    const auto side = static_cast<std::uint32_t>(field.cells.side);
    float sum = 0.0f;
    for (std::uint32_t i = row * side; i < (row + 1) * side; ++i) sum += field.column_cdf[i];
    field.row_cdf[row] = sum;
}

/// Weights of one row become its cumulative probabilities, with their uniform share.
PL_HD inline void build_row(const FieldPublicationView& field, std::uint32_t row) {
    const auto side = static_cast<std::uint32_t>(field.cells.side);
    const float total = sum_of(field.row_cdf.data + row / side * side, field.cells.side);
    for (std::uint32_t i = row * side; i < (row + 1) * side; ++i)
        field.column_cdf[i] = with_uniform_share(field, field.column_cdf[i], total, field.cells.count());
    accumulate_cdf(field.column_cdf.data + row * side, field.cells.side);
}

/// Weights of a volume's rows become its cumulative probabilities.
PL_HD inline void build_row_choice(const FieldPublicationView& field, std::uint32_t volume) {
    const int side = field.cells.side;
    float* rows = field.row_cdf.data + volume * static_cast<std::uint32_t>(side);
    const float total = sum_of(rows, side);
    for (int row = 0; row < side; ++row) rows[row] = with_uniform_share(field, rows[row], total, side);
    accumulate_cdf(rows, side);
}

/// Mean of what a volume has learned, once its cells have absorbed the pass's records.
PL_HD inline void publish_mean(const FieldPublicationView& field, std::uint32_t volume) {
    const auto cells = static_cast<std::uint32_t>(field.cells.count());
    field.mean_radiance[volume] = mean_of_visited(field, volume * cells);
}

/// Publishes one volume: absorbs the pass's records and rebuilds everything derived from the learned radiance. The
/// steps in their order; a device runs each for all volumes at once.
PL_HD inline void publish_volume(const FieldPublicationView& field, std::uint32_t volume) {
    const auto cells = static_cast<std::uint32_t>(field.cells.count());
    const auto side = static_cast<std::uint32_t>(field.cells.side);
    for (std::uint32_t cell = volume * cells; cell < (volume + 1) * cells; ++cell) absorb_records(field, cell);
    publish_mean(field, volume);
    for (std::uint32_t cell = volume * cells; cell < (volume + 1) * cells; ++cell) weigh_cell(field, cell);
    for (std::uint32_t row = volume * side; row < (volume + 1) * side; ++row) sum_row(field, row);
    for (std::uint32_t row = volume * side; row < (volume + 1) * side; ++row) build_row(field, row);
    build_row_choice(field, volume);
}

}  // namespace pl
