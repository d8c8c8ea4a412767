// The update of the values that a representation keeps beside its directions: irradiance, light samples and BSDF
// fractions.
#pragma once

#include <cmath>

#include "core/fields/field_arrays.h"
#include "core/kernel/guiding/direct_light.h"
#include "core/kernel/guiding/volume_irradiance.h"

namespace pl {

/// The arrays that a representation keeps beside its directions, to be written.
struct VolumeUpdateView : MixtureSums<Span, Span>, VolumeIrradiance<Span, Span>, LightSampleSums<Span, Span> {
    std::uint32_t light_clusters = 0;  ///< of the scene's light tree; 0: no tree
    float radiance_unit = 1.0f;
    LearningRate rate = LearningRate::Forgetful;
};

template <class Storage>
VolumeUpdateView volume_update_view(const FieldShape& shape, Storage& field) {
    VolumeUpdateView view;
    view.light_clusters = shape.light_clusters;
    view.radiance_unit = shape.radiance_unit;
    view.rate = shape.rate;
    set_arrays(mixture_arrays(kOfVolume) + kIrradianceArrays + kLightArrays, view, field);
    return view;
}

/// The learned value moved towards a new one; 0 for values that no update can produce.
inline float moved(float old, float to, float step) {
    const float value = old + step * (to - old);
    return value > 0.0f && value < kInfinity ? value : 0.0f;
}

/// Moves the irradiance of a volume towards the mean target of its new samples, weighted by cos / (pi q). Divided by the sum of
/// these weights, whose mean is 1: a ratio that no single sample can exceed.
inline void absorb_volume(const VolumeUpdateView& field, std::uint32_t volume) {
    absorb_light_samples(field, volume);
    const std::uint32_t fresh = field.pending_samples[volume];
    if (fresh == 0) return;
    const std::int64_t weight = field.pending_weight[volume];
    if (weight > 0) {
        const double sum = static_cast<double>(field.pending_value[volume]) / kStepsPerUnit;
        const double mean = sum / (static_cast<double>(weight) / kWeightSteps) * field.radiance_unit;
        const float step = learning_step(field.samples[volume], fresh, field.rate);
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
