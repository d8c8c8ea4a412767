// The update of a table: pending sums become learned radiance, and learned radiance becomes cumulative probabilities. Volumes
// are independent of each other and the arithmetic has a fixed order: the same bits on every back end.
#pragma once

#include "core/kernel/guiding/table_view.h"

namespace pl {

/// The learning rate. With N training samples in a cell and m new ones the learned radiance moves towards the mean of
/// the new ones by a step that depends on s = m/(N+m), one over the number n of batches of this size. Files store
/// these numbers.
enum class LearningRate : std::uint32_t {
    SampleMean = 1,  ///< s, the rate 1/(1+visits) of Dahm and Keller 2017: the mean of all targets
    /// s^0.7, the polynomial rate n^-0.7: between 1/2, where noise would stay, and 1   [Even-Dar and Mansour 2003]
    Power = 2,
    Floor = 3,  ///< s, but at least kLeastStep: never converges, always follows
    /// 1 - (1-s)^4: forgets early targets, which bootstrap from poor tables, and still averages the noise of later ones
    Forgetful = 4,
};

inline constexpr float kLeastStep = 0.05f;
inline constexpr float kPowerRate = 0.7f;

/// Uniform share of a table's probabilities: every cell has a positive one, which bounds the weight of light that no
/// training sample has found.
inline constexpr float kUniformShare = 0.1f;

/// All arrays of a table, to be written.
struct TableUpdateView : TableArrays<Span, Span> {
    DirectionCells cells;
    float radiance_unit = 1.0f;
    float extent = 0.0f;
    LearningRate rate = LearningRate::Forgetful;
    float uniform_floor = kUniformShare;
};

/// Step of a cell with `visits` training samples and `fresh` new ones. A function of m/(N+m) without a difference from 1, which
/// would lose every digit after ten million visits.
PL_HD inline float learning_step(std::uint32_t visits, std::uint32_t fresh, LearningRate rate) {
    const auto m = static_cast<float>(fresh);
    const float share = m / (static_cast<float>(visits) + m);
    if (rate == LearningRate::SampleMean) return share;
    if (rate == LearningRate::Floor) return max_of(share, kLeastStep);
    if (rate == LearningRate::Power) return min_of(power(share, kPowerRate), 1.0f);
    // 1 - (1-s)^4; rounding must not carry the mean past its targets.
    return min_of(share * (4.0f + share * (-6.0f + share * (4.0f - share))), 1.0f);
}

/// Learned radiance of a cell; 0 for values that no update can produce (NaN, infinite, negative: damaged memory). `field` is a
/// TableView or a TableUpdateView.
template <class Field>
PL_HD inline float learned_radiance(const Field& field, std::uint32_t cell) {
    const float radiance = field.radiance[cell];
    return radiance > 0.0f && radiance < kInfinity ? radiance : 0.0f;
}

/// Sum in ascending order of index.
PL_HD inline float sum_of(const float* values, int count) {
    float total = 0.0f;
    for (int i = 0; i < count; ++i) total += values[i];
    return total;
}

inline constexpr float kLargestFloat = std::numeric_limits<float>::max();

/// Mark of a cell without new training samples in the change that absorb_samples() leaves.
inline constexpr float kNoChange = -1.0f;

/// Moves the learned radiance of one cell towards the mean of its new training samples and empties the pending sums. Leaves the
/// absolute change of the cell in `column_cdf`, which later steps overwrite.
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

/// Means over a volume after absorb_samples() of its cells: of the learned radiance, with unvisited cells at the mean of the
/// others, and of the change of cells with new training samples.
PL_HD inline void update_means(const TableUpdateView& field, std::uint32_t volume) {
    const auto side = static_cast<std::uint32_t>(field.cells.side);
    float sum = 0.0f;
    float visited = 0.0f;
    float change = 0.0f;
    float changed = 0.0f;
    // Row by row, so that the sums of rows do not depend on each other.
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
    sum = min_of(sum, kLargestFloat);  // beyond it the mean is too small, but finite
    field.mean_radiance[volume] = visited > 0.0f ? sum / visited : 0.0f;
    if (changed > 0.0f) field.change[volume] = change / changed;
}

/// Visits as a weight; beyond a million one more changes no mean.
PL_HD inline float visit_weight(const TableUpdateView& field, std::uint32_t cell) {
    return static_cast<float>(static_cast<std::int32_t>(min_of(field.visits[cell], 1000000u)));
}

/// Unnormalized probabilities of one row of cells, and their sum: a cell's learned radiance with a prior for few visits, the
/// visit-weighted mean of its 3 x 3 neighborhood, itself with the volume's mean as prior. Never fed back into the learned
/// radiance, so it costs variance at most. Rows are numbered through all volumes.
PL_HD inline void weigh_row(const TableUpdateView& field, std::uint32_t row) {
    constexpr float kPriorVisits = 2.0f;
    const int side = field.cells.side;
    const int row_in_volume = static_cast<int>(row) % side;
    const std::uint32_t first = row * static_cast<std::uint32_t>(side);
    const float volume_mean = field.mean_radiance[row / static_cast<std::uint32_t>(side)];
    // Sums over the row and its neighbors, by column, with an empty column on either side.
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

/// Turns weights into inclusive cumulative probabilities ending in exactly 1; into those of the uniform distribution if the
/// total is not positive and finite. Returns the total of the weights, or 0.
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

/// Mixes n of `count` weights, whose sum over all is `total`, with the uniform floor, for accumulate_cdf() to normalize. A total
/// that is not finite, or too small to divide, gives the uniform distribution alone.
PL_HD inline void add_uniform_share(const TableUpdateView& field, float* weights, int n, float total, int count) {
    constexpr float kMinTotal = 0x1p-100f;
    const bool known = total > kMinTotal && total < kInfinity;
    const float own = 1.0f - field.uniform_floor;
    const float uniform = known ? field.uniform_floor * (total / static_cast<float>(count)) : 1.0f;
    for (int i = 0; i < n; ++i) weights[i] = known ? own * weights[i] + uniform : uniform;
}

/// Turns the weights of one row into its cumulative probabilities, with the uniform floor.
PL_HD inline void build_row(const TableUpdateView& field, std::uint32_t row) {
    const auto side = static_cast<std::uint32_t>(field.cells.side);
    const float total = sum_of(field.row_cdf.data + row / side * side, field.cells.side);
    float* weights = field.column_cdf.data + row * side;
    add_uniform_share(field, weights, field.cells.side, total, field.cells.count());
    accumulate_cdf(weights, field.cells.side);
}

/// Turns the weights of a volume's rows into their cumulative probabilities, with the uniform floor.
PL_HD inline void build_row_choice(const TableUpdateView& field, std::uint32_t volume) {
    const int side = field.cells.side;
    float* rows = field.row_cdf.data + volume * static_cast<std::uint32_t>(side);
    const float total = sum_of(rows, side);
    add_uniform_share(field, rows, side, total, side);
    accumulate_cdf(rows, side);
}

}  // namespace pl
