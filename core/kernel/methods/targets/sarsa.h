// Sarsa: a training sample is complete when the next vertex scatters.
// [Sutton and Barto 2018, section 6.4; Dahm and Keller 2017, section 3]
#pragma once

#include "core/kernel/methods/guided.h"
#include "core/kernel/methods/learning_target.h"

namespace pl {

/// The target for scattering from x, if the ray hits y and is scattered into w with weight f cos / pdf:
///   T = L + f cos / pdf Q(y, w)
/// with 0 instead of the product if the path is terminated at y, which the roulette weight of the surviving paths compensates.
///   all light        L = L_e(y)
///   indirect light   L = the share of L_e(y) that scattered directions bring, plus the radiance that y reflects of its own
///                    light sample, which a field of indirect light lacks
template <RadianceField F>
struct Sarsa : FieldTrainer<F> {
    using typename FieldTrainer<F>::Vertex;

    static constexpr bool serves(const LearningSettings& learning) {
        return learning.target == LearningTarget::Sarsa;
    }

    LearningSettings learning{};

    struct Memory {
        OpenSample<F> scattered;  ///< of the last direction
        OpenSample<F> lit;        ///< of the direction before: receives the radiance of the pending light sample
        float emitted = 0.0f;     ///< L
        float light = 0.0f;       ///< reflected radiance of the light sample
    };

    PL_HD void scattered(Memory& memory, const Vertex& vertex, const ScatterEvent& event,
                         MethodCounters& counters) const {
        const float radiance = vertex.is_served() ? this->field.radiance_at(vertex, event.direction.bin) : 0.0f;
        complete(memory, rms(event.weight) * radiance, counters);
        memory.scattered = this->open_sample(vertex, event.direction);
        memory.emitted = 0.0f;
    }

    PL_HD typename FieldTrainer<F>::Sample observe(Memory& memory, const Observation& observation,
                                                   const Vertex& vertex, MethodCounters& counters) const {
        memory.lit = {};
        if (!memory.scattered.entry.is_trained()) return {};
        const bool indirect = learning.light == LearnedLight::Indirect;
        memory.scattered.distance = observation.distance;
        memory.emitted = rms(observation.emitted) * (indirect ? observation.direction_share : 1.0f);
        if (is_black(observation.albedo)) {
            complete(memory, 0.0f, counters);
        } else if (!vertex.is_served()) {
            memory.scattered = {};  // the radiance reflected there is unknown
        } else if (indirect) {
            memory.lit = memory.scattered;
        }
        return {};
    }

    PL_HD typename FieldTrainer<F>::Light light_sampled(Memory& memory, const Vertex&,
                                                        const LightEstimate& estimate) const {
        memory.light = rms(estimate.reflected);
        return {};
    }
    PL_HD void light_received(Memory& memory, MethodCounters&) const {
        // Added, not recorded: the training sample is already counted.
        if (memory.lit.entry.is_trained()) this->field.add({memory.lit, memory.light}, this->mixture.learned != 0);
    }

    PL_HD void terminated(Memory& memory, MethodCounters& counters) const { complete(memory, 0.0f, counters); }

private:
    PL_HD void complete(Memory& memory, float reflected, MethodCounters& counters) const {
        if (!memory.scattered.entry.is_trained()) return;
        const float target = memory.emitted + reflected;
        this->train(memory.scattered, target);
        this->count_sample(target, counters);
        memory.scattered = {};
    }
};

}  // namespace pl
