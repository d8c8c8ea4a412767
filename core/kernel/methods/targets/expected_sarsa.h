// Expected Sarsa: a training sample is complete at the next vertex of the path.
// [Dahm and Keller 2017, "Learning Light Transport the Reinforced Way", section 3]
#pragma once

#include "core/kernel/methods/guided.h"

namespace pl {

/// The target T of ExpectedSarsa. `emitted`: L_e(y), times w for indirect light; `albedo`: rho(y); `value`: V(y); `direct`: D(y), 0 for
/// all light.
template <class N>
PL_INLINE typename N::Real expected_sarsa_target(const typename N::Real& emitted, const typename N::Real& albedo,
                                                 const typename N::Real& value, const typename N::Real& direct) {
    return emitted + albedo * (value + direct);
}

/// Target for scattering from x into the direction that hits y:
///   all light       T = L_e(y) + rho(y) V(y)
///   indirect light  T = w L_e(y) + rho(y) (V(y) + D(y))
/// The expectation over the next direction is the irradiance / pi V that the field keeps at y, one load. T has no BSDF of x:
/// the field holds incident radiance. w = q / (q + p_light) is the MIS weight of L_e(y) at x, and D(y) the irradiance / pi by
/// the light samples of y, which a field of indirect light keeps apart. Directions sampled in proportion to f T then have the
/// fixed point q = max(0, c f L - p_light): none goes where light samples do as well.   [compare Karlik et al. 2019, "MIS
/// Compensation: Optimizing Sampling Techniques in Multiple Importance Sampling"]
/// If y reflects but has no location, T is unknown and no sample is made.
template <GuidingField F>
struct ExpectedSarsa : FieldTrainer<F> {
    using typename FieldTrainer<F>::Vertex;
    using Memory = OpenSample<F>;  ///< of the last direction
    using Sample = TrainingSample<F>;
    using Light = LightSample<F>;

    static constexpr bool kLearnsLights = true;

    LearningSettings learning{};

    static constexpr bool serves(const LearningSettings& learning) {
        return learning.target == LearningTarget::ExpectedSarsa;
    }

    PL_HD void scattered(Memory& memory, const Vertex& vertex, const ScatterEvent& event, MethodCounters&) const {
        memory = this->open_sample(vertex, event.direction);
    }
    PL_HD Sample observe(Memory& memory, const Observation& observation, const Vertex& vertex,
                         MethodCounters& counters) const {
        if (!memory.entry.is_trained()) return {};
        const bool indirect = learning.light == LearnedLight::Indirect;
        float target = rms(observation.emitted) * (indirect ? observation.direction_share : 1.0f);
        if (!is_black(observation.albedo)) {
            if (!vertex.is_served()) return {};
            const float direct = indirect ? this->field.direct_at(vertex) : 0.0f;
            target =
                expected_sarsa_target<One>(target, rms(observation.albedo), this->field.value_at(vertex), direct);
        }
        this->count_sample(target, counters);
        memory.distance = observation.distance;
        return {memory, target};
    }
    PL_HD void record(const Sample& sample) const { this->train(sample, sample.target); }

    PL_HD Light light_sampled(Memory&, const Vertex& vertex, const LightEstimate& estimate) const {
        return {vertex, estimate.irradiance, estimate.cluster};
    }
    PL_HD void record_light(Light light, bool is_visible) const {
        if (!this->trains || learning.light != LearnedLight::Indirect || !light.location.is_served()) return;
        if (!is_visible) light.irradiance = 0.0f;
        this->field.record_light(light);
    }
};

}  // namespace pl
