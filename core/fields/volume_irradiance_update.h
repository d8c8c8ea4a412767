// The update of the values that a representation keeps beside its directions: irradiance, light samples and BSDF
// fractions. For the storage of any representation with arrays of these names.
#pragma once

#include <cmath>

#include "core/fields/field_shape.h"
#include "core/fields/placement_storage.h"
#include "core/kernel/guiding/direct_light.h"
#include "core/kernel/guiding/volume_irradiance.h"

namespace pl {

/// The views by which BSDF fractions and the light samples of a volume are updated as those of tables are.
template <class Storage>
TableUpdateView mixture_view(Storage& field) {
    TableUpdateView view;
    view.pending_slope = view_of(field.pending_slope);
    view.pending_curvature = view_of(field.pending_curvature);
    view.mixture_target = view_of(field.mixture_target);
    view.mixture_weight = view_of(field.mixture_weight);
    view.bsdf_fraction = view_of(field.bsdf_fraction);
    return view;
}
template <class Storage>
TableUpdateView light_view(const FieldShape& shape, Storage& field) {
    TableUpdateView view;
    view.light_clusters = shape.light_clusters;
    view.radiance_unit = shape.radiance_unit;
    view.rate = shape.rate;
    view.pending_direct = view_of(field.pending_direct);
    view.pending_direct_count = view_of(field.pending_direct_count);
    view.direct = view_of(field.direct);
    view.direct_count = view_of(field.direct_count);
    view.pending_cluster = view_of(field.pending_cluster);
    view.cluster_light = view_of(field.cluster_light);
    view.light_cdf = view_of(field.light_cdf);
    return view;
}

/// The learned value moved towards a new one; 0 for values that no update can produce.
inline float moved(float old, float to, float step) {
    const float value = old + step * (to - old);
    return value > 0.0f && value < kInfinity ? value : 0.0f;
}

/// Moves the irradiance of a volume towards the mean target of its new samples, weighted by cos / (pi q). Divided by the sum of
/// these weights, whose mean is 1: a ratio that no single sample can exceed. `lights` is light_view().
template <class Storage>
void absorb_volume(const FieldShape& shape, Storage& field, const TableUpdateView& lights, std::uint32_t volume) {
    absorb_light_samples(lights, volume);
    const std::uint32_t fresh = field.pending_samples[volume];
    if (fresh == 0) return;
    const std::int64_t weight = field.pending_weight[volume];
    if (weight > 0) {
        const double sum = static_cast<double>(field.pending_value[volume]) / kStepsPerUnit;
        const double mean = sum / (static_cast<double>(weight) / kWeightSteps) * shape.radiance_unit;
        const float step = learning_step(field.samples[volume], fresh, shape.rate);
        const float old = field.mean_radiance[volume];
        field.mean_radiance[volume] = moved(old, static_cast<float>(mean), step);
        field.change[volume] = std::fabs(field.mean_radiance[volume] - old);
    }
    field.samples[volume] = add_visits<One>(field.samples[volume], fresh);
    field.pending_value[volume] = 0;
    field.pending_weight[volume] = 0;
    field.pending_samples[volume] = 0;
}

}  // namespace pl
