// What the views of all representations have in common: arrays that most of them keep beside their directions, the parameters of their
// sums, and fixed point.
#pragma once

#include "core/kernel/base/atomics.h"
#include "core/kernel/base/math.h"
#include "core/kernel/guiding/direction_cells.h"
#include "core/kernel/guiding/placement_view.h"

namespace pl {

/// A Span that only reads; a type of its own, because nvcc takes an alias template for the template that it names.
template <class T>
struct ConstSpan : Span<const T> {
    using Span<const T>::Span;
};

// The arrays of representations are templates over two kinds of memory. `Learned` arrays change in updates only and are constant while
// paths are traced; `Pending` arrays are sums that paths add to between two updates. So one description serves host memory, device
// memory, files, and kernels that trace paths, <ConstSpan, Span>, or update a field, <Span, Span>.

/// The learned BSDF fraction, see mixture.h: one for each [volume], or for each [leaf] of an SD-tree.
template <template <class> class Learned, template <class> class Pending>
struct MixtureSums {
    Pending<std::int64_t> pending_slope;  ///< see record_mixture()
    Pending<std::int64_t> pending_curvature;
    Learned<float> mixture_target;  ///< sum of curvature times aim of the Newton steps so far
    Learned<float> mixture_weight;  ///< sum of their curvature
    Learned<float> bsdf_fraction;   ///< learned, the a of the mixture
};

/// The light of light samples, see direct_light.h: of radiance volumes, and of the clusters of the scene's light tree.
template <template <class> class Learned, template <class> class Pending>
struct LightSampleSums {
    Pending<std::int64_t> pending_direct;         ///< of irradiance / pi, fixed point. [volume]
    Pending<std::uint32_t> pending_direct_count;  ///< of light samples, occluded ones included. [volume]
    Learned<float> direct;                        ///< mean irradiance / pi. [volume]
    Learned<std::uint32_t> direct_count;          ///< light samples so far. [volume]
    Pending<std::int64_t> pending_cluster;        ///< of irradiance / pi, fixed point. [volume][cluster]
    Learned<float> cluster_light;                 ///< mean irradiance / pi. [volume][cluster]
    Learned<float>
        light_cdf;  ///< inclusive cumulative probabilities ending in 1; all 0 before enough samples. [volume][cluster]
};

/// The irradiance of radiance volumes whose directions are not cells of a hemisphere, see volume_irradiance.h. [volume]
template <template <class> class Learned, template <class> class Pending>
struct VolumeIrradiance {
    Learned<float> mean_radiance;            ///< irradiance / pi
    Learned<std::uint32_t> samples;          ///< training samples so far
    Pending<std::int64_t> pending_value;     ///< of target times weight, fixed point
    Pending<std::int64_t> pending_weight;    ///< of weights cos / (pi density), fixed point
    Pending<std::uint32_t> pending_samples;  ///< of training samples
    Learned<float> change;                   ///< |new - old| mean radiance of the last update that moved it
};

/// Besides its arrays, what a kernel that traces paths knows of a field with one hemisphere per radiance volume.
struct FieldView : PlacementView {
    DirectionCells cells;              ///< of the hemispheres; fields without tables are shown by them
    std::uint32_t light_clusters = 0;  ///< of the scene's light tree; 0: no tree
    float radiance_unit = 1.0f;        ///< of the fixed-point sums: a power of two not below the brightest emission
    Writers writers = Writers::Many;   ///< threads that add to the pending sums
};

/// Targets are clamped at this multiple of the field's radiance unit before they are summed. Pictures are not.
inline constexpr float kMaxRecordedUnits = 65536.0f;

/// Steps per radiance unit of the fixed-point sums: 2^-24 resolves a float's mantissa, and 63 bits hold 2^23 - 1 samples of
/// the largest target between two updates.
inline constexpr float kStepsPerUnit = 16777216.0f;

/// Whether the sums will hold less than the target.
PL_HD inline bool is_clamped(float target, float radiance_unit) { return target > kMaxRecordedUnits * radiance_unit; }

/// Fixed-point steps of a target; 0 for NaN and negative values.
PL_HD inline std::int64_t to_fixed_point(float target, float radiance_unit) {
    const float units = target / radiance_unit;
    if (!(units > 0.0f)) return 0;
    return static_cast<std::int64_t>(min_of(units, kMaxRecordedUnits) * kStepsPerUnit);
}

/// Mean target of `count` training samples, whose sum in fixed-point steps is rounded to `steps`.
template <class N>
PL_INLINE typename N::Real mean_of_steps(const typename N::Real& steps, const typename N::Uint& count,
                                         float radiance_unit) {
    return (steps / kStepsPerUnit) / N::count_to_real(count) * radiance_unit;
}
PL_HD inline float from_fixed_point(std::int64_t sum, std::uint32_t count, float radiance_unit) {
    return mean_of_steps<One>(static_cast<float>(sum), count, radiance_unit);
}

}  // namespace pl
