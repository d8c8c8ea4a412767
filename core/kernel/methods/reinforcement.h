// Reinforcement path tracing: Expected Sarsa on radiance volumes, learned by the same paths that make the picture.
// [Dahm and Keller 2017, "Learning Light Transport the Reinforced Way", section 3]
#pragma once

#include "core/kernel/methods/guided.h"

namespace pl {

struct ReinforcementMethod : GuidedSampling {
    using Vertex = GuidedVertex;
    using Expectation = GuidedExpectation;

    /// The table entry that chose (or could have chosen) the last direction.
    struct Memory {
        std::int32_t volume = kNoVolume;
        std::int32_t cell = 0;
        float bsdf_ratio = 1.0f;  ///< density of BSDF sampling over that of the mixture
    };

    PL_HD Memory remember(const Vertex& vertex, const DirectionSample& direction) const {
        if (direction.cell < 0) return {};
        return {vertex.volume, direction.cell, direction.bsdf_pdf_sa / direction.pdf_sa};
    }

    /// What is to be added to the table entry that chose the last direction.
    struct Record {
        std::int32_t volume = kNoVolume;  ///< none: nothing was learned
        std::int32_t cell = 0;
        float bsdf_ratio = 1.0f;
        float target = 0.0f;  ///< observed incident radiance, luminance
    };

    /// Expected Sarsa target T = L_e(y) + rho(y) V(y): the expectation over the next direction is the irradiance
    /// that the volume at y keeps, so it costs one load. T is not multiplied by the BSDF at x: the table holds
    /// incident radiance. Where y reflects but no volume serves it, nothing is known and nothing recorded.
    PL_HD Record learn(const Memory& memory, const Arrival& arrival, const Vertex& vertex,
                       MethodCounters& counters) const {
        if (memory.volume == kNoVolume) return {};
        float target = luminance(arrival.emitted);
        if (!is_black(arrival.albedo)) {
            if (vertex.volume == kNoVolume) return {};
            target += luminance(arrival.albedo) * field.mean_radiance[static_cast<std::uint32_t>(vertex.volume)];
        }
        ++counters.records;
        return {memory.volume, memory.cell, memory.bsdf_ratio, target};
    }

    PL_HD void commit(const Record& learned) const {
        if (learned.volume == kNoVolume) return;
        record(field, learned.volume, learned.cell, learned.target);
        if (mixture.learned != 0) record_mixture(field, learned.volume, learned.bsdf_ratio, learned.target);
    }
};
static_assert(Method<ReinforcementMethod>);

}  // namespace pl
