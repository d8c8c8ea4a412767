// Reinforcement path tracing: Expected Sarsa on radiance volumes, learned by the same paths that make the picture.
// [Dahm and Keller 2017, "Learning Light Transport the Reinforced Way", section 3]
#pragma once

#include "core/kernel/methods/guided.h"

namespace pl {

struct ReinforcementMethod : GuidedSampling {
    using Vertex = GuidedVertex;
    using Expectation = GuidedExpectation;

    using Memory = TableEntry;  ///< of the last direction

    PL_HD Memory remember(const Vertex& vertex, const DirectionSample& direction) const {
        return entry_of(vertex, direction);
    }

    /// What is to be added to the entry of the last direction; no entry: nothing was learned.
    struct Record : TableEntry {
        float target = 0.0f;  ///< observed incident radiance, luminance
    };

    /// Expected Sarsa target T = L_e(y) + rho(y) V(y): the expectation over the next direction is the irradiance
    /// that the volume at y keeps, so it costs one load. T is not multiplied by the BSDF at x: the table holds
    /// incident radiance. Where y reflects but no volume serves it, nothing is known and nothing recorded.
    PL_HD Record learn(Memory& memory, const Arrival& arrival, const Vertex& vertex, MethodCounters& counters) const {
        if (memory.volume == kNoVolume) return {};
        float target = luminance(arrival.emitted);
        if (!is_black(arrival.albedo)) {
            if (vertex.volume == kNoVolume) return {};
            target += luminance(arrival.albedo) * field.mean_radiance[static_cast<std::uint32_t>(vertex.volume)];
        }
        count_record(target, counters);
        memory.distance = arrival.distance;
        return {memory, target};
    }

    PL_HD void commit(const Record& learned) const { record_target(learned, learned.target); }
};
static_assert(Method<ReinforcementMethod>);

}  // namespace pl
