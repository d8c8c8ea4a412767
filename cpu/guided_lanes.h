// Directions of the guided methods for a vector of paths. Included by one file per instruction set; see lanes.h.
#pragma once

#include "cpu/lane_kernels.h"
#include "cpu/lanes.h"
#include "cpu/philox_lanes.h"

namespace pl {
namespace {

/// The lanes of a group from `first` on.
PL_INLINE void sample_guided_lanes(const GuidedMixture& mixture, const DrawKey& jitter_key, const GuidedGroup& paths,
                                   DirectionGroup& directions, std::uint32_t first) {
    const auto row = [&](const auto* values) { return load_lanes<LaneFloat>(values + first); };
    const auto draw_jitter = [&] {
        const PhiloxWords<LaneFloat> jitter = draw_lanes(jitter_key, paths.counters, first);
        return Real2<Lanes>{jitter.v[0], jitter.v[1]};
    };
    const GuidedPlace<Lanes> place{load_lanes<LaneInt>(paths.volume + first),
                                   {row(paths.position_x), row(paths.position_y), row(paths.position_z)},
                                   {row(paths.normal_x), row(paths.normal_y), row(paths.normal_z)}};
    const GuidedDirection<Lanes> direction =
        mixture.sample(place, row(paths.choice), {row(paths.u_x), row(paths.u_y)}, draw_jitter);
    store_lanes(direction.wi.x, directions.x + first);
    store_lanes(direction.wi.y, directions.y + first);
    store_lanes(direction.wi.z, directions.z + first);
    store_lanes(direction.pdf_sa, directions.pdf_sa + first);
    store_lanes(direction.bsdf_pdf_sa, directions.bsdf_pdf_sa + first);
    store_lanes(direction.cell, directions.cell + first);
}

PL_INLINE void sample_guided_groups(const GuidedMixture& mixture, const DrawKey& jitter_key, const GuidedGroup* paths,
                                    DirectionGroup* directions, std::uint32_t groups) {
    for (std::uint32_t group = 0; group < groups; ++group)
        for (std::uint32_t first = 0; first < kGroupSize; first += kLaneWidth)
            sample_guided_lanes(mixture, jitter_key, paths[group], directions[group], first);
}

}  // namespace
}  // namespace pl
