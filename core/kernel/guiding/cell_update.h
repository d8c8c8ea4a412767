// The arithmetic of the update of a table, of one cell or of a vector of them: templates over N, see core/kernel/base/numbers.h.
// table_update.h applies it cell by cell, cpu/lanes/update_lanes.h in SIMD lanes. All functions are inlined: files compiled for
// one instruction set share none with the rest of the program.
#pragma once

#include "core/kernel/guiding/table_view.h"

namespace pl {

/// The learning rate. With N training samples in a cell and m new ones the learned radiance moves towards the mean of
/// the new samples by a step that depends on s = m/(N+m). Files store these numbers, and 2 and 3 name no rate.
enum class LearningRate : std::uint32_t {
    SampleMean = 1,  ///< s, the rate 1/(1+visits) of Dahm and Keller 2017: the mean of all targets
    /// 1 - (1-s)^4: forgets early targets, which bootstrap from poor tables, and still averages the noise of later ones
    Forgetful = 4,
};

/// Uniform share of a table's probabilities: every cell keeps a positive probability, which bounds the weight of light
/// that no training sample has found.
inline constexpr float kUniformShare = 0.1f;

/// Step of a cell with `visits` training samples and `fresh` new ones. A function of m/(N+m) without a difference from 1, which
/// would lose every digit after ten million visits.
template <class N>
PL_INLINE typename N::Real learning_step(const typename N::Uint& visits, const typename N::Uint& fresh,
                                         LearningRate rate) {
    const typename N::Real m = N::count_to_real(fresh);
    const typename N::Real share = m / (N::count_to_real(visits) + m);
    if (rate == LearningRate::SampleMean) return share;
    // 1 - (1-s)^4; rounding must not carry the mean past its targets.
    return min_real<N>(share * (4.0f + share * (-6.0f + share * (4.0f - share))), 1.0f);
}

/// The radiance itself, or 0 for values that no update can produce (NaN, infinite, negative: damaged memory).
template <class N>
PL_INLINE typename N::Real sound_radiance(const typename N::Real& radiance) {
    const auto sound = static_cast<typename N::Mask>((radiance > 0.0f) & (radiance < kInfinity));
    return select(sound, radiance, N::constant(0.0f));
}

/// Visits after `fresh` more, without wrapping.
template <class N>
PL_INLINE typename N::Uint add_visits(const typename N::Uint& visits, const typename N::Uint& fresh) {
    const typename N::Uint sum = visits + fresh;
    return select(static_cast<typename N::Mask>(sum < fresh), N::count(0xffffffffu), sum);
}

/// Visits as a weight; beyond a million one more changes no mean.
template <class N>
PL_INLINE typename N::Real visit_weight(const typename N::Uint& visits) {
    constexpr std::uint32_t kMost = 1000000u;
    return N::to_real(N::to_int(select(static_cast<typename N::Mask>(visits > kMost), N::count(kMost), visits)));
}

/// Mark of a cell without new training samples in place of its change.
inline constexpr float kNoChange = -1.0f;
/// Mark of a cell without any in place of its learned radiance.
inline constexpr float kUnvisited = -1.0f;

/// Sums over a row, or over the rows of a volume.
template <class N>
struct MeanSums {
    typename N::Real radiance = N::constant(0.0f);  ///< learned radiance of visited cells
    typename N::Real visited = N::constant(0.0f);   ///< their number
    typename N::Real change = N::constant(0.0f);    ///< absolute change of cells with new training samples
    typename N::Real changed = N::constant(0.0f);   ///< their number

    /// Adds a cell by its learned radiance or kUnvisited, and its change or kNoChange.
    PL_INLINE void add_cell(const typename N::Real& learned, const typename N::Real& moved) {
        const auto zero = N::constant(0.0f);
        const auto one = N::constant(1.0f);
        const typename N::Mask counts = learned != kUnvisited;
        radiance += select(counts, learned, zero);
        visited += select(counts, one, zero);
        const typename N::Mask is_moved = moved != kNoChange;
        change += select(is_moved, moved, zero);
        changed += select(is_moved, one, zero);
    }
    PL_INLINE void add_row(const MeanSums& row) {
        radiance += row.radiance;
        visited += row.visited;
        change += row.change;
        changed += row.changed;
    }
    PL_INLINE float mean_radiance() const {
        constexpr float kLargestFloat = std::numeric_limits<float>::max();
        const float sum = kLargestFloat < radiance ? kLargestFloat : radiance;  // too small a mean, but finite
        return visited > 0.0f ? sum / visited : 0.0f;
    }
};

/// Sums over three cells of a column, of their visits as weights and of the learned radiance times these.
template <class N>
struct ColumnSums {
    typename N::Real visits, light;
};

/// Unnormalized probability of a cell: its learned radiance with a prior for few visits, the visit-weighted mean of its 3 x 3
/// neighborhood, itself with the volume's mean as prior. `own` holds the cell alone.
template <class N>
PL_INLINE typename N::Real cell_weight(float volume_mean, const ColumnSums<N>& own, const ColumnSums<N>& left,
                                       const ColumnSums<N>& middle, const ColumnSums<N>& right) {
    constexpr float kPriorVisits = 2.0f;
    const auto sum = kPriorVisits * volume_mean + left.light + middle.light + right.light;
    const auto weight = kPriorVisits + left.visits + middle.visits + right.visits;
    return (own.light + kPriorVisits * (sum / weight)) / (own.visits + kPriorVisits);
}

/// Whether weights can be divided by their total.
template <class N>
PL_INLINE typename N::Mask is_usable_total(const typename N::Real& total) {
    return static_cast<typename N::Mask>((total > 0.0f) & (total < kInfinity));
}

/// Mixes weights, whose sum over `count` of them is `total`, with the uniform floor. A total that is not finite, or too small to
/// divide, gives the uniform distribution alone.
struct UniformMix {
    bool known;
    float own, uniform;

    PL_INLINE UniformMix(float floor, float total, int count)
        : known(total > 0x1p-100f && total < kInfinity), own(1.0f - floor),
          uniform(known ? floor * (total / static_cast<float>(count)) : 1.0f) {}

    template <class N>
    PL_INLINE typename N::Real mixed(const typename N::Real& weight) const {
        return known ? own * weight + uniform : N::constant(uniform);
    }
};

}  // namespace pl
