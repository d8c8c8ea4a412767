// The irradiance by light samples of a volume: the part of the light that light samples bring, which a field trained for
// scattered directions leaves to them. By it, lights are chosen where there are many. Of any
// representation: `View` has LightSampleSums, to be written, `light_clusters`, `radiance_unit` and `rate`.
#pragma once

#include "core/kernel/guiding/table_update.h"

namespace pl {

/// Light samples of a volume before which their clusters are chosen by the light tree alone.
inline constexpr std::uint32_t kFewestLightSamples = 32;

/// Derives the probabilities of the clusters of lights from their irradiance by light samples, occlusion included; none while it
/// is 0.   [compare Vevoda et al. 2018, "Bayesian Online Regression for Adaptive Direct Illumination Sampling"]
template <class View>
PL_HD void build_light_choice(const View& field, std::uint32_t volume) {
    const std::uint32_t first = volume * field.light_clusters;
    const std::uint32_t last = first + field.light_clusters - 1;
    float total = 0.0f;
    for (std::uint32_t i = first; i <= last; ++i) total += field.cluster_light[i];
    if (!(total > 0x1p-100f) || !(total < kInfinity)) return;
    float sum = 0.0f;
    for (std::uint32_t i = first; i < last; ++i) {
        sum += field.cluster_light[i];
        field.light_cdf[i] = min_of(sum / total, 1.0f);
    }
    field.light_cdf[last] = 1.0f;
}

/// Moves the irradiance by each cluster of lights by `step` towards the mean of `fresh` new light samples.
template <class View>
PL_HD void absorb_light_clusters(const View& field, std::uint32_t volume, std::uint32_t fresh, float step) {
    for (std::uint32_t i = volume * field.light_clusters; i < (volume + 1) * field.light_clusters; ++i) {
        const float mean = from_fixed_point(field.pending_cluster[i], fresh, field.radiance_unit);
        field.cluster_light[i] += step * (mean - field.cluster_light[i]);
        field.pending_cluster[i] = 0;
    }
    if (field.direct_count[volume] >= kFewestLightSamples) build_light_choice(field, volume);
}

/// Moves a volume's irradiance by light samples towards the mean of new light samples, at the rate of the cells, because their MIS
/// weights follow the tables.
template <class View>
PL_HD void absorb_light_samples(const View& field, std::uint32_t volume) {
    const std::uint32_t fresh = field.pending_direct_count[volume];
    if (fresh == 0) return;
    const float mean = from_fixed_point(field.pending_direct[volume], fresh, field.radiance_unit);
    const float step = learning_step(field.direct_count[volume], fresh, field.rate);
    field.direct[volume] += step * (mean - field.direct[volume]);
    field.direct_count[volume] += min_of(fresh, 0xffffffffu - field.direct_count[volume]);
    field.pending_direct[volume] = 0;
    field.pending_direct_count[volume] = 0;
    if (field.light_clusters > 0) absorb_light_clusters(field, volume, fresh, step);
}

}  // namespace pl
