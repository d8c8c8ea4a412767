// The arrays of mixtures of lobes, named once for files, memory and kernels. Their lengths and initial values are in
// core/fields/lobe_model.h.
#pragma once

#include <cstdint>

#include "core/kernel/base/span.h"

namespace pl {

/// Most lobes of a mixture, and those of a fresh one. Half of the 32 and 16 of Ruppert et al. 2020: a volume serves the surface
/// points of one normal, whose hemisphere takes half the lobes of a sphere.
inline constexpr std::uint32_t kMostLobes = 16;
inline constexpr std::uint32_t kFirstLobes = 8;

/// Statistics of a lobe: means over training samples of responsibility times a quantity, the first of them times the weight
/// w = target / density. Directions are those at the volume's site, in the frame of its normal.
enum LobeMoment : std::uint32_t {
    kMomentWeight,  ///< w: radiance times steradians
    kMomentX,       ///< w times direction
    kMomentY,
    kMomentZ,
    kMomentInverse,  ///< w / distance from the site, in units of 1 / extent
    kMomentXx,       ///< w times products of the direction's components; that of z z follows from the weight
    kMomentXy,
    kMomentXz,
    kMomentYy,
    kMomentYz,
    kMomentSquare,  ///< (w / its mean)^2: how few samples bring the light
    kMomentMisfit,  ///< f^2 / (density mixture), f the normalized target: chi-square of Pearson
    kLobeMoments
};

/// One mixture per radiance volume, and the volume's irradiance. `Learned` arrays change in updates only and are constant while
/// paths are traced; `Pending` ones are sums that paths add to between two updates. A lobe is numbered volume * kMostLobes + i.
template <template <class> class Learned, template <class> class Pending>
struct LobeArrays {
    Learned<std::uint32_t> lobe_count;  ///< of the volume, 1 to kMostLobes. [volume]
    Learned<float> weight;              ///< share of the lobe in its mixture; 0 of those not in use. [lobe]
    Learned<float> mean;                ///< unit direction in the frame of the volume's normal. [lobe][3]
    Learned<float> kappa;               ///< concentration. [lobe]
    Learned<float> inverse_distance;    ///< from the site to the lobe's light, in units of 1 / extent. [lobe]
    Learned<float> moments;             ///< statistics so far. [lobe][LobeMoment]
    Learned<std::uint32_t> age;         ///< updates since the lobe was split or merged. [lobe]
    Learned<float> total;  ///< integral of learned radiance over directions; 0: nothing is known. [volume]
    Pending<std::int64_t> pending_moments;  ///< sums of new training samples, fixed point. [lobe][LobeMoment]

    Pending<std::int64_t> pending_slope;      ///< see record_mixture(). [volume]
    Pending<std::int64_t> pending_curvature;  ///< [volume]
    Learned<float> mixture_target;            ///< sum of curvature times aim of the Newton steps so far. [volume]
    Learned<float> mixture_weight;            ///< sum of their curvature. [volume]
    Learned<float> bsdf_fraction;             ///< learned share of the BSDF in the mixture. [volume]

    // As in SdTreeArrays.
    Learned<float> mean_radiance;            ///< irradiance / pi. [volume]
    Learned<std::uint32_t> samples;          ///< training samples so far. [volume]
    Pending<std::int64_t> pending_value;     ///< of target times weight, fixed point. [volume]
    Pending<std::int64_t> pending_weight;    ///< of weights cos / (pi density), fixed point. [volume]
    Pending<std::uint32_t> pending_samples;  ///< of training samples. [volume]
    Learned<float> change;                   ///< |new - old| mean radiance of the last update that moved it. [volume]
    Pending<std::int64_t> pending_direct;    ///< of irradiance / pi by light samples, fixed point. [volume]
    Pending<std::uint32_t> pending_direct_count;  ///< of light samples, occluded ones included. [volume]
    Learned<float> direct;                        ///< mean irradiance / pi by light samples. [volume]
    Learned<std::uint32_t> direct_count;          ///< light samples so far. [volume]
    Pending<std::int64_t> pending_cluster;        ///< of irradiance / pi, fixed point. [volume][cluster]
    Learned<float> cluster_light;                 ///< mean irradiance / pi. [volume][cluster]
    Learned<float> light_cdf;  ///< inclusive cumulative probabilities; all 0 before enough samples. [volume][cluster]
};

}  // namespace pl
