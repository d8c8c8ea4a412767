// A method under observation: it samples the same directions, notes the choices that leave no trace in the path's state, and
// trains nothing.
#pragma once

#include <optional>

#include "core/kernel/methods/guided.h"
#include "core/kernel/methods/targets/expected_sarsa.h"

namespace pl::diagnose {

/// Choices and the training sample since the last vertex.
struct ObservedChoices {
    bool samples_field = false;  ///< the last direction was sampled by the field
    DirectionSample direction{};
    float estimate = 1.0f;  ///< contribution estimate
    bool is_light_visible = false;
    std::optional<float> target;  ///< of the training sample that the end of the last segment completes
};

/// A field that notes whether it was sampled.
template <GuidingField F>
struct ObservedField : F {
    ObservedChoices* choices = nullptr;

    Vec3f sample(const typename F::Location& location, const SurfacePoint& surface,
                 const ScatterUniforms& numbers) const {
        choices->samples_field = true;
        return F::sample(location, surface, numbers);
    }
    void record(const TrainingSample<ObservedField>&, bool) const {}
    void add(const TrainingSample<ObservedField>&, bool) const {}
    void record_light(const LightSample<ObservedField>&) const {}
};

template <class F>
using ObservedGuided = Guided<ObservedField<F>, ExpectedSarsa>;

template <Method M>
struct Observed : M {
    using Vertex = typename M::Vertex;
    using M::pdf_sa;
    ObservedChoices* choices;

    Observed(const M& method, ObservedChoices& noted) : M(method), choices(&noted) {
        if constexpr (GuidedMethod<M>) this->field.choices = &noted;
    }

    DirectionSample sample_direction(const Vertex& vertex, const SurfacePoint& surface,
                                     const ScatterUniforms& numbers) const {
        choices->samples_field = false;
        return choices->direction = M::sample_direction(vertex, surface, numbers);
    }
    template <FeatureSet B>
    DirectionSample sample_direction(const Vertex& vertex, const SurfacePoint& surface, const LayeredBsdf<B>& bsdf,
                                     const ScatterUniforms& numbers) const {
        choices->samples_field = false;
        return choices->direction = M::sample_direction(vertex, surface, bsdf, numbers);
    }
    float estimate_contribution(const Vertex& vertex, Vec3f albedo, Vec3f throughput, float survival,
                                typename M::Expectation& expectation) const {
        return choices->estimate = M::estimate_contribution(vertex, albedo, throughput, survival, expectation);
    }
    void record(const typename M::Sample& sample) const {
        if constexpr (GuidedMethod<M>) {
            if (sample.entry.is_trained()) choices->target = sample.target;
        }
    }
    void record_light(const typename M::Light&, bool is_visible) const { choices->is_light_visible = is_visible; }
};

}  // namespace pl::diagnose
