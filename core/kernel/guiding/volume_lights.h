// Light samples of radiance volumes, of any field whose arrays have one entry for each volume: irradiance, and the choice of lights.
#pragma once

#include "core/kernel/guiding/guiding_field.h"
#include "core/kernel/guiding/table_view.h"

namespace pl {

/// Learned choice of lights of one volume; empty before its first light.
template <class Field>
PL_HD LearnedLights lights_of_volume(const Field& field, std::int32_t volume) {
    if (field.light_clusters == 0) return {};
    const float* cdf = field.light_cdf.data + static_cast<std::uint32_t>(volume) * field.light_clusters;
    return cdf[field.light_clusters - 1] > 0.0f ? LearnedLights{cdf} : LearnedLights{};
}

/// Adds a light sample to the pending sums of its volume.
template <class Field>
PL_HD void record_at_volume(const Field& field, const LightSample<Field>& light) {
    const auto volume = static_cast<std::uint32_t>(light.location.volume);
    const std::int64_t steps = to_fixed_point(light.irradiance, field.radiance_unit);
    atomic_add_counted(field.pending_direct[volume], steps, field.pending_direct_count[volume], field.writers);
    if (light.cluster < field.light_clusters && steps != 0)
        atomic_add(field.pending_cluster[volume * field.light_clusters + light.cluster], steps, field.writers);
}

}  // namespace pl
