// Between passes: what the pass recorded becomes the table of the next one. One volume at a time, each independent
// of the others, plain arithmetic in a fixed order: the same bits on every back end.
#pragma once

#include "core/kernel/fields/table_field.h"

namespace pl {

/// How fast old targets are forgotten. With N records in a cell and m new ones the mean moves towards the new ones by a
/// step that depends on s = m/(N+m): one over the number n of batches like this one. The numbers are those of files.
enum class LearningRate : std::uint32_t {
    SampleMean = 1,  ///< s, the rate 1/(1+visits) of Dahm and Keller 2017: all targets count alike
    /// s^0.7, the polynomial rate n^-0.7: between 1/2, where noise would stay, and 1   [Even-Dar and Mansour 2003]
    Power = 2,
    Floor = 3,  ///< s, but at least kLeastStep: never stops following, never free of noise
    /// 1 - (1-s)^4: forgets the early targets, which came from tables that knew little, and still averages the noise of the
    /// later ones
    Forgetful = 4,
};

inline constexpr float kLeastStep = 0.05f;
inline constexpr float kPowerRate = 0.7f;

/// Share of a table that is uniform, so that no cell is ever impossible, and unseen light never weighs much.
inline constexpr float kUniformShare = 0.1f;

/// Everything publication writes, one row per volume.
struct TableUpdateView {
    DirectionCells cells;
    float radiance_unit = 1.0f;
    float extent = 0.0f;
    LearningRate rate = LearningRate::Forgetful;
    float uniform_floor = kUniformShare;

    Span<float> radiance;               ///< learned incident radiance Q. [volume][cell]
    Span<std::uint32_t> visits;         ///< records so far. [volume][cell]
    Span<std::int64_t> pending_sum;     ///< emptied. [volume][cell]
    Span<std::uint32_t> pending_count;  ///< emptied. [volume][cell]
    Span<float> row_cdf;                ///< [volume][row]
    Span<float> column_cdf;             ///< [volume][row][column]
    Span<float> mean_radiance;          ///< [volume]
    Span<float> change;                 ///< mean |new - old| of the cells that had records last. [volume]

    Span<std::int64_t> pending_slope;      ///< emptied. [volume]
    Span<std::int64_t> pending_curvature;  ///< emptied. [volume]
    Span<float> mixture_target;            ///< sum of curvature times aim of the steps so far. [volume]
    Span<float> mixture_weight;            ///< sum of their curvature. [volume]
    Span<float> bsdf_fraction;             ///< [volume]

    Span<std::int64_t> pending_distance;  ///< emptied. [volume]
    Span<std::int64_t> pending_light;     ///< emptied. [volume]
    Span<float> reach_distance;           ///< sum of weight times distance of the records so far. [volume]
    Span<float> reach_weight;             ///< sum of their weights. [volume]
    Span<float> inverse_reach;            ///< [volume]
};

/// Share of the new mean that `fresh` new records get. Written in terms of m/(N+m), because a difference from 1 would lose
/// every digit after ten million visits.
PL_HD inline float learning_step(std::uint32_t visits, std::uint32_t fresh, LearningRate rate) {
    const auto m = static_cast<float>(fresh);
    const float share = m / (static_cast<float>(visits) + m);
    if (rate == LearningRate::SampleMean) return share;
    if (rate == LearningRate::Floor) return max_of(share, kLeastStep);
    if (rate == LearningRate::Power) return min_of(power(share, kPowerRate), 1.0f);
    // 1 - (1-s)^4; rounding must not carry the mean past its targets.
    return min_of(share * (4.0f + share * (-6.0f + share * (4.0f - share))), 1.0f);
}

/// What a cell has learned, or 0 where memory holds what no record could have put there: NaN, infinite, negative.
/// `field` is a TableField or a TableUpdateView.
template <class Field>
PL_HD inline float learned_radiance(const Field& field, std::uint32_t cell) {
    const float radiance = field.radiance[cell];
    return radiance > 0.0f && radiance < kInfinity ? radiance : 0.0f;
}

/// Sum in order of number.
PL_HD inline float sum_of(const float* values, int count) {
    float total = 0.0f;
    for (int i = 0; i < count; ++i) total += values[i];
    return total;
}

inline constexpr float kLargestFloat = std::numeric_limits<float>::max();

/// Mark of a cell that had no record, where absorb_samples() leaves how much the others have changed.
inline constexpr float kNoChange = -1.0f;

/// Moves the learned radiance of one cell towards the mean of its new records and empties the sums. Leaves in
/// `column_cdf`, which the later steps write anew, how much the cell has changed.
PL_HD inline void absorb_samples(const TableUpdateView& field, std::uint32_t cell) {
    const std::uint32_t fresh = field.pending_count[cell];
    field.column_cdf[cell] = kNoChange;
    if (fresh == 0) return;
    const float mean = from_fixed_point(field.pending_sum[cell], fresh, field.radiance_unit);
    const float step = learning_step(field.visits[cell], fresh, field.rate);
    const float old = learned_radiance(field, cell);
    field.radiance[cell] = old + step * (mean - old);
    field.column_cdf[cell] = std::fabs(field.radiance[cell] - old);
    const std::uint32_t room = 0xffffffffu - field.visits[cell];
    field.visits[cell] += min_of(fresh, room);
    field.pending_sum[cell] = 0;
    field.pending_count[cell] = 0;
}

/// Means over a volume, once its cells have absorbed the pass's records: what it has learned, where cells never visited
/// count as the mean of the others, and how much the cells with records have changed.
PL_HD inline void update_means(const TableUpdateView& field, std::uint32_t volume) {
    const auto side = static_cast<std::uint32_t>(field.cells.side);
    float sum = 0.0f;
    float visited = 0.0f;
    float change = 0.0f;
    float changed = 0.0f;
    // Row by row: the sums of rows do not wait for each other.
    for (std::uint32_t row = volume * side; row < (volume + 1) * side; ++row) {
        float row_sum = 0.0f;
        float row_visited = 0.0f;
        float row_change = 0.0f;
        float row_changed = 0.0f;
        for (std::uint32_t cell = row * side; cell < (row + 1) * side; ++cell) {
            const bool counts = field.visits[cell] > 0;
            row_sum += counts ? learned_radiance(field, cell) : 0.0f;
            row_visited += counts ? 1.0f : 0.0f;
            const bool moved = field.column_cdf[cell] != kNoChange;
            row_change += moved ? field.column_cdf[cell] : 0.0f;
            row_changed += moved ? 1.0f : 0.0f;
        }
        sum += row_sum;
        visited += row_visited;
        change += row_change;
        changed += row_changed;
    }
    sum = min_of(sum, kLargestFloat);  // beyond it the mean is too small, but a number
    field.mean_radiance[volume] = visited > 0.0f ? sum / visited : 0.0f;
    if (changed > 0.0f) field.change[volume] = change / changed;
}

/// Visits as weights of a mean; beyond a million one record more changes nothing.
PL_HD inline float visit_weight(const TableUpdateView& field, std::uint32_t cell) {
    return static_cast<float>(static_cast<std::int32_t>(min_of(field.visits[cell], 1000000u)));
}

/// Weights of one row of cells before anything is normalized, and their sum: what each cell is thought to receive.
/// With few visits a cell leans on the visit-weighted mean of its 3 x 3 neighbours, and that mean on the volume's.
/// Never fed back into what is learned, so it can cost noise but not bias. Rows are numbered through all volumes.
PL_HD inline void weigh_row(const TableUpdateView& field, std::uint32_t row) {
    constexpr float kPriorVisits = 2.0f;
    const int side = field.cells.side;
    const int row_in_volume = static_cast<int>(row) % side;
    const std::uint32_t first = row * static_cast<std::uint32_t>(side);
    const float volume_mean = field.mean_radiance[row / static_cast<std::uint32_t>(side)];
    // Of the row and its neighbours, column by column, with an empty column on either side.
    float visits[kMaxSide + 2];
    float radiance[kMaxSide + 2];  // times visits
    visits[0] = radiance[0] = visits[side + 1] = radiance[side + 1] = 0.0f;
    const auto add_row = [&](std::uint32_t start) {
        for (int x = 0; x < side; ++x) {
            const std::uint32_t cell = start + static_cast<std::uint32_t>(x);
            const float weight = visit_weight(field, cell);
            visits[x + 1] += weight;
            radiance[x + 1] += weight * learned_radiance(field, cell);
        }
    };
    for (int x = 0; x < side; ++x) visits[x + 1] = radiance[x + 1] = 0.0f;
    if (row_in_volume > 0) add_row(first - static_cast<std::uint32_t>(side));
    add_row(first);
    if (row_in_volume + 1 < side) add_row(first + static_cast<std::uint32_t>(side));
    for (int x = 0; x < side; ++x) {
        const std::uint32_t cell = first + static_cast<std::uint32_t>(x);
        const float sum = kPriorVisits * volume_mean + radiance[x] + radiance[x + 1] + radiance[x + 2];
        const float weight = kPriorVisits + visits[x] + visits[x + 1] + visits[x + 2];
        const float own = visit_weight(field, cell);
        field.column_cdf[cell] =
            (own * learned_radiance(field, cell) + kPriorVisits * (sum / weight)) / (own + kPriorVisits);
    }
    field.row_cdf[row] = sum_of(field.column_cdf.data + first, side);
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

/// Mixes weights that are parts of `total` with equal shares of it, `count` in all, for accumulate_cdf() to normalize. A
/// total that is unusable, or too small to be divided, gives equal shares alone.
PL_HD inline void add_uniform_share(const TableUpdateView& field, float* weights, int n, float total, int count) {
    constexpr float kMinTotal = 0x1p-100f;
    const bool known = total > kMinTotal && total < kInfinity;
    const float own = 1.0f - field.uniform_floor;
    const float uniform = known ? field.uniform_floor * (total / static_cast<float>(count)) : 1.0f;
    for (int i = 0; i < n; ++i) weights[i] = known ? own * weights[i] + uniform : uniform;
}

/// Weights of one row become its cumulative probabilities, with their uniform share.
PL_HD inline void build_row(const TableUpdateView& field, std::uint32_t row) {
    const auto side = static_cast<std::uint32_t>(field.cells.side);
    const float total = sum_of(field.row_cdf.data + row / side * side, field.cells.side);
    float* weights = field.column_cdf.data + row * side;
    add_uniform_share(field, weights, field.cells.side, total, field.cells.count());
    accumulate_cdf(weights, field.cells.side);
}

/// Weights of a volume's rows become its cumulative probabilities.
PL_HD inline void build_row_choice(const TableUpdateView& field, std::uint32_t volume) {
    const int side = field.cells.side;
    float* rows = field.row_cdf.data + volume * static_cast<std::uint32_t>(side);
    const float total = sum_of(rows, side);
    add_uniform_share(field, rows, side, total, side);
    accumulate_cdf(rows, side);
}

}  // namespace pl
