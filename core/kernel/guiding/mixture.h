// The BSDF fraction a of the mixture q = a p_bsdf + (1-a) p_table, learned per volume with one step per update. It minimizes
// the Kullback-Leibler divergence of q from the ideal density, proportional to f L cos, as in Mueller et al. ("Practical Path
// Guiding in Production", 2019), but by Newton steps instead of Adam: their sums are integers, so the order of the training
// samples does not change a bit.
#pragma once

#include "core/kernel/guiding/table_update.h"

namespace pl {

/// Bounds of the learned fraction: q never loses either of its parts.
inline constexpr float kMinBsdfFraction = 0.1f;
inline constexpr float kMaxBsdfFraction = 0.9f;
/// BSDF fraction of a volume without training samples. For any table the second moment of a path's throughput grows by at most
/// albedo^2 / a per vertex: with this fraction it stays finite for albedos below 0.7.
inline constexpr float kInitialBsdfFraction = 0.5f;

/// How guided methods choose the BSDF fraction, and lights.
struct MixtureSettings {
    std::uint32_t learned = 1;  ///< 1: each volume's own fraction, if the method learns while it renders
    float bsdf_fraction = kInitialBsdfFraction;  ///< in [0.1, 1], of all volumes, if it is not learned
    std::uint32_t learned_lights = 1;            ///< 1: lights by each volume's learned choice, if there is one

    /// Directions and lights of the baseline method: the field is trained, but guides nothing.
    static constexpr MixtureSettings unguided() { return {.learned = 0, .bsdf_fraction = 1.0f, .learned_lights = 0}; }

    friend bool operator==(const MixtureSettings&, const MixtureSettings&) = default;
};

/// Fixed-point steps per unit of the sums, and the largest weight of one training sample: it adds less than 2^33 steps.
inline constexpr float kMixtureStepsPerUnit = 65536.0f;
inline constexpr float kMaxMixtureWeight = 64.0f;

/// Weight of a training sample for the BSDF fraction and the reach: f L cos / q up to a factor that is the same for
/// all samples of the volume, clamped. `bsdf_ratio` is p_bsdf / q of the direction, `radiance` the target. 0 without
/// radiance, or if the mean radiance of the volume is 0.
PL_HD inline float light_weight(const TableView& field, std::int32_t volume, float bsdf_ratio, float radiance) {
    const float expected = field.mean_radiance_of(static_cast<std::uint32_t>(volume));
    if (!(expected > 0.0f) || !(radiance > 0.0f)) return 0.0f;
    return min_of(radiance / expected, kMaxMixtureWeight) * bsdf_ratio;
}

/// Adds one training sample to the sums of the Newton step. With y = (p_bsdf - p_table) / q = (bsdf_ratio - 1) / (1 - a) and
/// w = f L cos / q relative to its mean, the first two derivatives of the divergence by a are -E[w y] and E[w y^2]; the
/// factors of 1-a, constant between two updates, are applied in move_mixture(). `weight` is light_weight().
/// `field`: a view with MixtureSums; `index`: of the volume or leaf that learns.
template <class Field>
PL_HD void record_mixture(const Field& field, std::uint32_t index, float bsdf_ratio, float weight) {
    if (!(weight > 0.0f)) return;
    const float excess = bsdf_ratio - 1.0f;
    const float slope = -weight * excess * kMixtureStepsPerUnit;
    const float curvature = weight * excess * excess * kMixtureStepsPerUnit;
    atomic_add(field.pending_slope[index], static_cast<std::int64_t>(slope), field.writers);
    atomic_add(field.pending_curvature[index], static_cast<std::int64_t>(curvature), field.writers);
}

/// Moves a volume's fraction to the mean of the Newton steps so far, weighted by curvature and recency: early steps
/// are based on worse tables.
PL_HD inline void move_mixture(const MixtureSums<Span, Span>& field, std::uint32_t volume) {
    constexpr float kKept = 0.9f;             // weight of the older steps, per update with training samples
    constexpr float kPriorCurvature = 32.0f;  // weight of the initial fraction, about thirty training samples
    const float old = field.bsdf_fraction[volume];
    const float table_share = 1.0f - old;
    const float slope = static_cast<float>(field.pending_slope[volume]) / (kMixtureStepsPerUnit * table_share);
    const float curvature =
        static_cast<float>(field.pending_curvature[volume]) / (kMixtureStepsPerUnit * table_share * table_share);
    field.pending_slope[volume] = 0;
    field.pending_curvature[volume] = 0;
    if (!(curvature > 0.0f)) return;
    const float target = kKept * field.mixture_target[volume] + (curvature * old - slope);
    const float weight = kKept * field.mixture_weight[volume] + curvature;
    field.mixture_target[volume] = target;
    field.mixture_weight[volume] = weight;
    field.bsdf_fraction[volume] =
        clamp_to((target + kPriorCurvature * kInitialBsdfFraction) / (weight + kPriorCurvature), kMinBsdfFraction,
                 kMaxBsdfFraction);
}

}  // namespace pl
