// Monte-Carlo targets: the radiance of the rest of the path.   [Sutton and Barto 2018, section 5.1]
#pragma once

#include "core/kernel/methods/guided.h"
#include "core/kernel/methods/learning_target.h"

namespace pl {

/// With y_1, y_2, ... the vertices after x, w_i the weights f cos / pdf (times the weight of roulette) of the
/// directions scattered there, s_i the MIS share of L_e(y_i) of scattered directions, and D_i the radiance of its
/// light sample reflected at y_i, the return is
///   R_i = s_i L_e(y_i) + D_i + w_i R_(i+1),   T = R_1 (indirect light), T = R_1 + (1 - s_1) L_e(y_1) (all light).
/// A path remembers up to kMostSteps vertices until it ends. Beyond them its returns are truncated: rho V replaces
/// the rest, later vertices make no training samples, and the path is counted in cut_returns.
template <GuidingField F>
struct MonteCarlo : FieldTrainer<F> {
    using typename FieldTrainer<F>::Vertex;

    static constexpr bool serves(const LearningSettings& learning) {
        return learning.target == LearningTarget::MonteCarlo;
    }

    static constexpr std::int32_t kMostSteps = 16;

    LearningSettings learning{};

    /// A scattered direction and the radiance along it.
    struct Step {
        OpenSample<F> open;
        float unshared = 0.0f;  ///< (1 - s) L_e
        Vec3f brought{0.0f};    ///< s L_e + D
        Vec3f weight{0.0f};     ///< w
    };
    struct Store {
        Step steps[kMostSteps];
    };
    struct Memory {
        Step* steps = nullptr;
        std::int32_t count = 0;
        std::int32_t lit = -1;  ///< step of the light sample whose shadow ray is pending; negative: none
        std::uint32_t is_cut = 0;
        Vec3f light{0.0f};  ///< reflected radiance of that light sample

        PL_HD void keep(Store* store) { steps = store->steps; }
    };

    PL_HD typename FieldTrainer<F>::Sample observe(Memory& memory, const Observation& observation, const Vertex&,
                                                   MethodCounters&) const {
        memory.lit = -1;
        if (memory.count == 0 || memory.is_cut != 0) return {};
        Step& last = memory.steps[memory.count - 1];
        last.open.distance = observation.distance;
        last.brought = observation.direction_share * observation.emitted;
        if (learning.light == LearnedLight::All)
            last.unshared = (1.0f - observation.direction_share) * rms(observation.emitted);
        return {};
    }

    PL_HD typename FieldTrainer<F>::Light light_sampled(Memory& memory, const Vertex&,
                                                        const LightEstimate& estimate) const {
        if (memory.count == 0 || memory.is_cut != 0) return {};
        memory.lit = memory.count - 1;
        memory.light = estimate.reflected;
        return {};
    }
    PL_HD void light_received(Memory& memory, MethodCounters&) const {
        if (memory.lit >= 0) memory.steps[memory.lit].brought += memory.light;
        memory.lit = -1;
    }

    PL_HD void scattered(Memory& memory, const Vertex& vertex, const ScatterEvent& event,
                         MethodCounters& counters) const {
        if (memory.is_cut != 0) return;
        if (memory.count < kMostSteps) {
            if (memory.count > 0) memory.steps[memory.count - 1].weight = event.weight;
            memory.steps[memory.count++] = {.open = this->open_sample(vertex, event.direction)};
            return;
        }
        memory.is_cut = 1;
        ++counters.cut_returns;
        if (!vertex.is_served()) return;
        // V includes direct light, unless only indirect light is learned: only then is the light sample added.
        if (learning.light == LearnedLight::All) memory.lit = -1;
        memory.steps[memory.count - 1].brought += event.albedo * this->field.value_at(vertex);
    }

    PL_HD void finished(Memory& memory, MethodCounters& counters) const {
        Vec3f brought{0.0f};
        for (std::int32_t i = memory.count - 1; i >= 0; --i) {
            const Step& step = memory.steps[i];
            brought = step.brought + step.weight * brought;
            if (!step.open.entry.is_trained()) continue;
            const float target = rms(brought) + step.unshared;
            this->train(step.open, target);
            this->count_sample(target, counters);
        }
        memory.count = 0;
    }
};

}  // namespace pl
