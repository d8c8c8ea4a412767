// How much of a volume's sampling is left to the BSDF: a share that each volume learns, one step per publication.
// The share minimizes the Kullback-Leibler divergence of the mixture q = a p_bsdf + (1-a) p_table from what a perfect
// sampler would draw, f L cos, like Mueller et al. ("Practical Path Guiding in Production", 2019), by Newton steps
// instead of Adam: the sums of a pass are integers, so every order of the records gives the same bits.
#pragma once

#include "core/kernel/fields/table_update.h"

namespace pl {

/// Bounds of the learned share: the density never loses either of its parts.
inline constexpr float kMinBsdfFraction = 0.1f;
inline constexpr float kMaxBsdfFraction = 0.9f;
/// Share of a volume that knows nothing. Whatever the table says, the second moment of a path's weight grows by at most
/// albedo^2 / a per vertex: with this share it stays finite for albedos below 0.7.
inline constexpr float kInitialBsdfFraction = 0.5f;

/// How the guided methods mix.
struct MixtureSettings {
    std::uint32_t learned = 1;  ///< 1: each volume's own share, where the method learns while it renders
    float bsdf_fraction = kInitialBsdfFraction;  ///< in [0.1, 1], for all volumes, where it is not learned

    friend bool operator==(const MixtureSettings&, const MixtureSettings&) = default;
};

/// Steps per unit of the sums, and the largest weight of one record: a record adds less than 2^33.
inline constexpr float kMixtureStepsPerUnit = 65536.0f;
inline constexpr float kMaxMixtureWeight = 64.0f;

/// How much light a direction brought, as a share of what the volume expects, over the density that sampled it.
/// `bsdf_ratio` = p_bsdf / q of the direction; `radiance` what arrived. 0 where nothing is expected, or nothing came.
PL_HD inline float light_weight(const TableField& field, std::int32_t volume, float bsdf_ratio, float radiance) {
    const float expected = field.mean_radiance[static_cast<std::uint32_t>(volume)];
    if (!(expected > 0.0f) || !(radiance > 0.0f)) return 0.0f;
    return min_of(radiance / expected, kMaxMixtureWeight) * bsdf_ratio;
}

/// Adds one direction that was sampled at a volume and what arrived from there.
/// With y = (p_bsdf - p_table) / q = (bsdf_ratio - 1) / (1 - a) and w = f L cos / q relative to its mean, the
/// derivatives of the divergence by a are -E[w y] and E[w y^2]; the factors of 1-a, the same for all records of a pass,
/// are left to move_mixture(). `weight` is light_weight().
PL_HD inline void record_mixture(const TableField& field, std::int32_t volume, float bsdf_ratio, float weight) {
    const auto index = static_cast<std::uint32_t>(volume);
    if (!(weight > 0.0f)) return;
    const float excess = bsdf_ratio - 1.0f;
    const float slope = -weight * excess * kMixtureStepsPerUnit;
    const float curvature = weight * excess * excess * kMixtureStepsPerUnit;
    atomic_add(field.pending_slope[index], static_cast<std::int64_t>(slope), field.writers);
    atomic_add(field.pending_curvature[index], static_cast<std::int64_t>(curvature), field.writers);
}

/// Moves a volume's share to the mean of the Newton steps so far, each weighted by its curvature and by how recent it
/// is: early tables were worse.
PL_HD inline void move_mixture(const TableUpdateView& field, std::uint32_t volume) {
    constexpr float kKept = 0.9f;             // of the older steps, per publication that brought new ones
    constexpr float kPriorCurvature = 32.0f;  // of the initial share: as much as about thirty records
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
