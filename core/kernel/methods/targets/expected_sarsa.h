// Expected Sarsa: a training sample is complete at the next vertex of the path.
// [Dahm and Keller 2017, "Learning Light Transport the Reinforced Way", section 3]
#pragma once

#include "core/kernel/methods/guided.h"

namespace pl {

/// Target for scattering from x into the direction that hits y: T = L_e(y) + rho(y) V(y). The expectation over the
/// next direction is the irradiance / pi that the field keeps at y, one load. T has no BSDF of x: the field holds
/// incident radiance. If y reflects but has no location, T is unknown and no sample is made.
template <GuidingField F>
struct ExpectedSarsa : FieldTrainer<F> {
    using typename FieldTrainer<F>::Vertex;
    using Memory = OpenSample<F>;  ///< of the last direction
    using Sample = TrainingSample<F>;

    static constexpr bool serves(const LearningSettings& learning, bool samples_lights) {
        return is_complete_at_next_vertex(learning, samples_lights);
    }

    PL_HD void scattered(Memory& memory, const Vertex& vertex, const ScatterEvent& event, MethodCounters&) const {
        memory = this->open_sample(vertex, event.direction);
    }
    PL_HD Sample observe(Memory& memory, const Observation& observation, const Vertex& vertex,
                         MethodCounters& counters) const {
        if (!memory.entry.is_trained()) return {};
        float target = luminance(observation.emitted);
        if (!is_black(observation.albedo)) {
            if (!vertex.is_served()) return {};
            target += luminance(observation.albedo) * this->field.value_at(vertex);
        }
        this->count_sample(target, counters);
        memory.distance = observation.distance;
        return {memory, target};
    }
    PL_HD void record(const Sample& sample) const { this->train(sample, sample.target); }
};

}  // namespace pl
