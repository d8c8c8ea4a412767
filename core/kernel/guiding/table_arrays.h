// The arrays of a field of tables, named once for files, host memory, device memory and kernels. Their lengths,
// initial values and division when a volume is split are in core/fields/table_model.h.
#pragma once

#include <cstdint>

#include "core/kernel/base/span.h"

namespace pl {

/// `Learned` arrays change in updates only and are constant while paths are traced; `Pending` ones are sums that paths add to
/// between two updates. Shapes: [volume][cell] with cells row by row, [volume][row], or [volume].
template <template <class> class Learned, template <class> class Pending>
struct TableArrays {
    Learned<float> radiance;               ///< learned incident radiance Q, rms(). [volume][cell]
    Learned<std::uint32_t> visits;         ///< training samples so far. [volume][cell]
    Pending<std::int64_t> pending_sum;     ///< of targets, fixed point. [volume][cell]
    Pending<std::uint32_t> pending_count;  ///< of training samples. [volume][cell]

    /// Inclusive cumulative probabilities, each row ending in exactly 1.
    Learned<float> row_cdf;     ///< [volume][row]
    Learned<float> column_cdf;  ///< within the row. [volume][row][column]

    Learned<float> mean_radiance;  ///< cosine-weighted mean of Q over the hemisphere: irradiance / pi. [volume]
    Pending<std::int64_t> pending_direct;         ///< of irradiance / pi by light samples, fixed point. [volume]
    Pending<std::uint32_t> pending_direct_count;  ///< of light samples, occluded ones included. [volume]
    Learned<float> direct;                        ///< mean irradiance / pi by light samples. [volume]
    Learned<std::uint32_t> direct_count;          ///< light samples so far. [volume]
    /// By the light samples of one cluster of the scene's light tree; empty without a tree. [volume][cluster]
    Pending<std::int64_t> pending_cluster;  ///< of irradiance / pi, fixed point
    Learned<float> cluster_light;           ///< mean irradiance / pi
    Learned<float> light_cdf;  ///< inclusive cumulative probabilities ending in 1; all 0 before enough light samples
    Learned<float> change;     ///< mean |new - old| of the cells that the last update moved. [volume]

    Pending<std::int64_t> pending_slope;      ///< see record_mixture(). [volume]
    Pending<std::int64_t> pending_curvature;  ///< [volume]
    Learned<float> mixture_target;            ///< sum of curvature times aim of the Newton steps so far. [volume]
    Learned<float> mixture_weight;            ///< sum of their curvature. [volume]
    Learned<float> bsdf_fraction;             ///< learned share of the BSDF in the mixture. [volume]

    Pending<std::int64_t> pending_distance;  ///< see record_reach(). [volume]
    Pending<std::int64_t> pending_light;     ///< [volume]
    Learned<float> reach_distance;  ///< sum of weight times distance of the training samples so far. [volume]
    Learned<float> reach_weight;    ///< sum of their weights. [volume]
    Learned<float> inverse_reach;   ///< one over the radius of Parallax. [volume]
};

}  // namespace pl
