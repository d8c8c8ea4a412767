// The arrays of an SD-tree, named once for files, memory and kernels. Their lengths and initial values are in
// core/fields/sd_tree_model.h.
#pragma once

#include <cstdint>

#include "core/kernel/base/span.h"

namespace pl {

/// A binary tree over space, each of whose leaves has a quadtree over directions; and the irradiance of the radiance volumes.
/// `Learned` arrays change in updates only and are constant while paths are traced; `Pending` ones are sums that paths add to
/// between two updates. A slot is one quadrant of a node of a quadtree: slot = 4 node + quadrant.
template <template <class> class Learned, template <class> class Pending>
struct SdTreeArrays {
    Learned<std::uint32_t> spatial;     ///< SpatialNode::word. [spatial node]
    Learned<std::uint32_t> first_node;  ///< root of the quadtree, whose nodes follow one another. [leaf]

    Learned<float> energy;                 ///< integral of incident radiance over the quadrant, in steradians. [slot]
    Learned<std::uint32_t> child;          ///< node that divides the quadrant, counted from the root; 0: none. [slot]
    Pending<std::int64_t> pending_energy;  ///< of target / density, fixed point. [slot]

    Learned<std::uint32_t> visits;            ///< training samples so far; divided where a leaf is split. [leaf]
    Pending<std::uint32_t> pending_count;     ///< of training samples. [leaf]
    Pending<std::int64_t> pending_slope;      ///< see record_mixture(). [leaf]
    Pending<std::int64_t> pending_curvature;  ///< [leaf]
    Learned<float> mixture_target;            ///< sum of curvature times aim of the Newton steps so far. [leaf]
    Learned<float> mixture_weight;            ///< sum of their curvature. [leaf]
    Learned<float> bsdf_fraction;             ///< learned share of the BSDF in the mixture. [leaf]

    Learned<float> mean_radiance;            ///< irradiance / pi. [volume]
    Learned<std::uint32_t> samples;          ///< training samples so far. [volume]
    Pending<std::int64_t> pending_value;     ///< of target times weight, fixed point. [volume]
    Pending<std::int64_t> pending_weight;    ///< of weights cos / (pi density), fixed point. [volume]
    Pending<std::uint32_t> pending_samples;  ///< of training samples. [volume]
    Learned<float> change;                   ///< |new - old| mean radiance of the last update that moved it. [volume]

    // As in TableArrays.
    Pending<std::int64_t> pending_direct;         ///< of irradiance / pi by light samples, fixed point. [volume]
    Pending<std::uint32_t> pending_direct_count;  ///< of light samples, occluded ones included. [volume]
    Learned<float> direct;                        ///< mean irradiance / pi by light samples. [volume]
    Learned<std::uint32_t> direct_count;          ///< light samples so far. [volume]
    Pending<std::int64_t> pending_cluster;        ///< of irradiance / pi, fixed point. [volume][cluster]
    Learned<float> cluster_light;                 ///< mean irradiance / pi. [volume][cluster]
    Learned<float> light_cdf;  ///< inclusive cumulative probabilities; all 0 before enough samples. [volume][cluster]
};

}  // namespace pl
