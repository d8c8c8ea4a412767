// Irradiance and BSDF fraction beside a representation whose directions are not cells of a volume's hemisphere: for views with
// VolumeIrradiance and MixtureSums.
#pragma once

#include "core/kernel/guiding/guiding_field.h"
#include "core/kernel/guiding/mixture.h"

namespace pl {

/// Bounds of the weights of one training sample: q is at least a tenth of the BSDF's density, so that only grazing directions meet
/// them. They limit the learned values, never a picture.
inline constexpr float kMostInverseDensity = 1024.0f;
inline constexpr float kMostCosineWeight = 16.0f;
/// Steps per unit of the sums of cosine weights.
inline constexpr float kWeightSteps = 16777216.0f;

/// 1 / q in steradians, clamped.
PL_HD inline float inverse_density(float pdf_sa) { return min_of(1.0f / pdf_sa, kMostInverseDensity); }
/// cos / (pi q) with the cosine to a volume's normal, clamped.
PL_HD inline float cosine_weight_of(float cosine, float pdf_sa) {
    return clamp_to(cosine * kInvPi / pdf_sa, 0.0f, kMostCosineWeight);
}

/// Counts a training sample for the irradiance of its volume.
template <class Field>
PL_HD void count_irradiance(const Field& field, std::uint32_t volume, float cosine_weight) {
    const auto weight = static_cast<std::int64_t>(cosine_weight * kWeightSteps);
    atomic_add(field.pending_weight[volume], weight, field.writers);
    atomic_add(field.pending_samples[volume], 1u, field.writers);
}

/// Adds to the sums of the Newton step of a BSDF fraction, see record_mixture(). `index`: of the volume or leaf that learns it.
template <class Field>
PL_HD void record_fraction(const Field& field, std::uint32_t index, std::uint32_t volume, float bsdf_ratio,
                           float target) {
    const float expected = field.mean_radiance[volume];
    if (!(expected > 0.0f)) return;
    const float weight = min_of(target / expected, kMaxMixtureWeight) * bsdf_ratio;
    record_mixture(field, index, bsdf_ratio, weight);
}

}  // namespace pl
