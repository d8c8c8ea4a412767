// Reinforcement that learns from whole paths: each record is the light that the path really brought.
// [Sutton and Barto 2018, section 5.1]
#pragma once

#include "core/kernel/methods/guided.h"
#include "core/kernel/methods/learning_target.h"

namespace pl {

/// With y_1, y_2, ... the vertices behind x, w_i the weights f cos / pdf (and of roulette) with which the path left them,
/// L_e(y_i) times the share s_i that directions have in it, and D_i what y_i reflects of its own light sample, the return is
///   R_i = s_i L_e(y_i) + D_i + w_i R_(i+1),   T = R_1 (indirect), T = R_1 + (1 - s_1) L_e(y_1) (all light).
/// The vertices of a path are remembered until it ends, up to kMostSteps; a longer path is cut there for learning only: in
/// the place of what follows stands rho V, and the vertices behind learn nothing. Such paths are counted.
struct MonteCarloMethod : GuidedSampling {
    using Vertex = GuidedVertex;
    using Expectation = GuidedExpectation;

    static constexpr std::int32_t kMostSteps = 16;

    LearningSettings learning{};

    /// A direction that was taken, and what it led to.
    struct Step {
        TableEntry entry;
        float unshared = 0.0f;  ///< (1 - s) L_e
        Vec3f brought{0.0f};    ///< s L_e + D
        Vec3f weight{0.0f};     ///< w
    };
    struct Memory {
        std::int32_t count = 0;
        std::int32_t lit = -1;  ///< the step whose light sample is on its way; none if negative
        std::uint32_t is_cut = 0;
        Vec3f light{0.0f};  ///< what that brings
        float roulette_weight = 1.0f;
        Step steps[kMostSteps];
    };
    struct Record {};  ///< all are made at the end of a path

    PL_HD Memory remember(const Vertex& vertex, const DirectionSample& direction) const {
        Memory memory;
        push(memory, vertex, direction);
        return memory;
    }

    PL_HD Record learn(Memory& memory, const Arrival& arrival, const Vertex&, MethodCounters&) const {
        memory.lit = -1;
        if (memory.count == 0 || memory.is_cut != 0) return {};
        Step& last = memory.steps[memory.count - 1];
        last.entry.distance = arrival.distance;
        last.brought = arrival.light_share * arrival.emitted;
        if (learning.light == LearnedLight::All)
            last.unshared = (1.0f - arrival.light_share) * luminance(arrival.emitted);
        return {};
    }
    PL_HD void commit(const Record&) const {}

    PL_HD void request_light(Memory& memory, Vec3f reflected) const {
        if (memory.count == 0 || memory.is_cut != 0) return;
        memory.lit = memory.count - 1;
        memory.light = reflected;
    }
    PL_HD void receive_light(Memory& memory, MethodCounters&) const {
        if (memory.lit >= 0) memory.steps[memory.lit].brought += memory.light;
        memory.lit = -1;
    }

    PL_HD void depart(Memory& memory, const Vertex& vertex, const Scattering& scattering,
                      MethodCounters& counters) const {
        if (memory.is_cut != 0) return;
        if (memory.count < kMostSteps) {
            if (memory.count > 0) memory.steps[memory.count - 1].weight = scattering.weight;
            push(memory, vertex, scattering.direction);
            return;
        }
        memory.is_cut = 1;
        ++counters.cut_returns;
        if (vertex.volume == kNoVolume) return;
        // V holds direct light too, unless only indirect light is learned: the light sample counts only then.
        if (learning.light == LearnedLight::All) memory.lit = -1;
        memory.steps[memory.count - 1].brought +=
            scattering.albedo * field.mean_radiance[static_cast<std::uint32_t>(vertex.volume)];
    }
    PL_HD void stop(Memory&, MethodCounters&) const {}

    PL_HD void finish(Memory& memory, MethodCounters& counters) const {
        Vec3f brought{0.0f};
        for (std::int32_t i = memory.count - 1; i >= 0; --i) {
            const Step& step = memory.steps[i];
            brought = step.brought + step.weight * brought;
            if (step.entry.volume == kNoVolume) continue;
            const float target = luminance(brought) + step.unshared;
            record_target(step.entry, target);
            count_record(target, counters);
        }
        memory.count = 0;
    }

private:
    PL_HD void push(Memory& memory, const Vertex& vertex, const DirectionSample& direction) const {
        memory.steps[memory.count++] = {.entry = entry_of(vertex, direction)};
    }
};
static_assert(FollowingMethod<MonteCarloMethod>);

}  // namespace pl
