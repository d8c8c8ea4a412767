// A von Mises-Fisher lobe on the sphere of directions: density, sampling and product, stable from uniform lobes to the narrowest.
// [Fisher 1953; Jakob 2012, "Numerically stable sampling of the von Mises-Fisher distribution on S2 (and other tricks)"]
#pragma once

#include "core/kernel/base/angles.h"
#include "core/kernel/base/equal_area_sphere.h"
#include "core/kernel/base/math.h"

namespace pl {

/// Largest concentration: half of the light within 0.4 degrees.   [as Ruppert et al. 2020]
inline constexpr float kMostKappa = 32000.0f;

/// Density kappa / (2 pi (1 - exp(-2 kappa))) exp(kappa (cos - 1)), with the cosine between direction and mean.
struct VmfLobe {
    Vec3f mean{0.0f, 0.0f, 1.0f};  ///< unit
    float kappa = 0.0f;            ///< concentration, in [0, kMostKappa]; 0: uniform
};

/// Density at the mean of a lobe, per steradian.
PL_INLINE float vmf_peak(float kappa) {
    constexpr float kNearlyUniform = 1.0e-3f;  // 1 + kappa is exact to 3e-7 below it
    const float peak = kappa * (0.5f * kInvPi) / complement_of_decay(2.0f * max_of(kappa, kNearlyUniform));
    return kappa < kNearlyUniform ? kUniformSpherePdf * (1.0f + kappa) : peak;
}

/// exp(kappa (cos - 1)), with 1 - cos as half of the squared chord, which keeps its digits near the mean.
PL_INLINE float vmf_falloff(Vec3f mean, float kappa, Vec3f wi) {
    const Vec3f chord = wi - mean;
    return decay_of(0.5f * kappa * glm::dot(chord, chord));
}

/// A direction of the lobe around +z; u in [0,1)^2. 1 - cos is computed first: it has all digits of a narrow lobe.
PL_HD inline Vec3f sample_vmf_local(float kappa, Vec2f u) {
    constexpr float kUniform = 1.0e-6f;
    const float drop = kappa < kUniform
                           ? 2.0f * u.x
                           : min_of(log_of_complement(u.x * complement_of_decay(2.0f * kappa)) / kappa, 2.0f);
    const float radius = safe_sqrt(drop * (2.0f - drop));
    const SineCosine turn = sine_cosine_of_positive_turns(u.y);
    return {radius * turn.cosine, radius * turn.sine, 1.0f - drop};
}

/// Mean cosine r of a lobe: coth(kappa) - 1 / kappa.
PL_HD inline float vmf_mean_cosine(float kappa) {
    constexpr float kNearlyUniform = 0.05f;  // the next term of the series is -kappa^3 / 45
    if (kappa < kNearlyUniform) return kappa / 3.0f;
    return 1.0f / std::tanh(kappa) - 1.0f / kappa;
}

/// Concentration of a mean cosine, nearly its inverse.   [Banerjee et al. 2005, "Clustering on the Unit Hypersphere using von
/// Mises-Fisher Distributions"]
PL_HD inline float vmf_kappa(float mean_cosine) {
    const float r = clamp_to(mean_cosine, 0.0f, 1.0f);
    const float rest = (1.0f - r) * (1.0f + r);
    const float kappa = r * (3.0f - r * r) / max_of(rest, 1.0e-12f);
    return min_of(kappa, kMostKappa);
}

/// The product of two lobes without their peaks: exp(k1 (cos1 - 1)) exp(k2 (cos2 - 1)) = scale exp(kappa (cos - 1)).
struct VmfProduct {
    VmfLobe lobe;
    float scale = 1.0f;
};

PL_INLINE VmfProduct vmf_product(const VmfLobe& a, const VmfLobe& b) {
    const Vec3f sum = a.kappa * a.mean + b.kappa * b.mean;
    const float kappa = glm::length(sum);
    const Vec3f chord = a.mean - b.mean;
    // kappa - k1 - k2, by the difference of their squares: exact for narrow lobes.
    const float excess = a.kappa * b.kappa * glm::dot(chord, chord) / max_of(kappa + a.kappa + b.kappa, 1.0e-12f);
    const bool is_uniform = !(kappa > 1.0e-6f);
    const float inverse = 1.0f / (is_uniform ? 1.0f : kappa);
    return {{{is_uniform ? a.mean.x : sum.x * inverse, is_uniform ? a.mean.y : sum.y * inverse,
              is_uniform ? a.mean.z : sum.z * inverse},
             min_of(kappa, kMostKappa)},
            decay_of(excess)};
}

}  // namespace pl
