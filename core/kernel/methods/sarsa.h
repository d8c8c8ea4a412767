// Reinforcement with targets that are complete only at the next vertex: Sarsa, and records without the light that light
// samples bring.   [Sutton and Barto 2018, section 6.4; Dahm and Keller 2017, section 3]
#pragma once

#include "core/kernel/methods/guided.h"
#include "core/kernel/methods/learning_target.h"

namespace pl {

/// The target for leaving x, when the ray meets y and is scattered into w with weight f cos / pdf:
///   Sarsa            T = L + f cos / pdf Q(y, w); 0 instead of the product where the path ends at y by chance, which the
///                    weight of the others makes up for
///   Expected Sarsa   T = L + rho(y) V(y)
///   all light        L = L_e(y)
///   indirect         L = L_e(y) times the share that directions have in it, and what y reflects of its own light sample,
///                    which tables without direct light lack
struct SarsaMethod : GuidedSampling {
    using Vertex = GuidedVertex;
    using Expectation = GuidedExpectation;

    LearningSettings learning{};

    struct Memory {
        TableEntry left;       ///< chose the last direction
        TableEntry lit;        ///< chose the one before: gets what the light sample on its way brings
        float emitted = 0.0f;  ///< L
        float light = 0.0f;    ///< what the light sample brings
        float roulette_weight = 1.0f;
    };
    struct Record {};  ///< made where a target is complete

    PL_HD Memory remember(const Vertex& vertex, const DirectionSample& direction) const {
        return {.left = entry_of(vertex, direction), .lit = {}};
    }

    PL_HD Record learn(Memory& memory, const Arrival& arrival, const Vertex& vertex, MethodCounters& counters) const {
        memory.lit = {};
        if (memory.left.volume == kNoVolume) return {};
        const bool indirect = learning.light == LearnedLight::Indirect;
        memory.left.distance = arrival.distance;
        memory.emitted = luminance(arrival.emitted) * (indirect ? arrival.light_share : 1.0f);
        if (is_black(arrival.albedo)) {
            settle(memory, 0.0f, counters);
        } else if (vertex.volume == kNoVolume) {
            memory.left = {};  // nothing is known there
        } else if (learning.target == LearningTarget::ExpectedSarsa) {
            const TableEntry left = memory.left;
            settle(memory, luminance(arrival.albedo) * mean_radiance(vertex), counters);
            if (indirect) memory.lit = left;
        } else if (indirect) {
            memory.lit = memory.left;
        }
        return {};
    }
    PL_HD void commit(const Record&) const {}

    PL_HD void request_light(Memory& memory, Vec3f reflected) const { memory.light = luminance(reflected); }
    PL_HD void receive_light(Memory& memory, MethodCounters&) const {
        if (memory.lit.volume == kNoVolume) return;
        // Only the sum: the record that it belongs to has been counted, or is where the path was scattered.
        const std::uint32_t index = field.cell_index(memory.lit.volume, memory.lit.cell);
        atomic_add(field.pending_sum[index], to_fixed_point(memory.light, field.radiance_unit), field.writers);
        record_light(memory.lit, memory.light);
    }

    PL_HD void depart(Memory& memory, const Vertex& vertex, const Scattering& scattering,
                      MethodCounters& counters) const {
        settle(memory, luminance(scattering.weight) * table_radiance(vertex, scattering.direction.cell), counters);
        const TableEntry lit = memory.lit;
        const float light = memory.light;
        memory = remember(vertex, scattering.direction);
        memory.lit = lit;
        memory.light = light;
    }
    PL_HD void stop(Memory& memory, MethodCounters& counters) const { settle(memory, 0.0f, counters); }
    PL_HD void finish(Memory&, MethodCounters&) const {}

private:
    PL_HD float mean_radiance(const Vertex& vertex) const {
        return field.mean_radiance[static_cast<std::uint32_t>(vertex.volume)];
    }
    /// Q of a cell; where nothing is known of it, or the direction is below the volume's horizon, the volume's mean.
    PL_HD float table_radiance(const Vertex& vertex, std::int32_t cell) const {
        if (vertex.volume == kNoVolume) return 0.0f;
        if (cell < 0) return mean_radiance(vertex);
        const std::uint32_t index = field.cell_index(vertex.volume, cell);
        return field.visits[index] == 0 ? mean_radiance(vertex) : learned_radiance(field, index);
    }
    PL_HD void settle(Memory& memory, float reflected, MethodCounters& counters) const {
        if (memory.left.volume == kNoVolume) return;
        const float target = memory.emitted + reflected;
        record_target(memory.left, target);
        count_record(target, counters);
        memory.left = {};
    }
};
static_assert(FollowingMethod<SarsaMethod>);

}  // namespace pl
