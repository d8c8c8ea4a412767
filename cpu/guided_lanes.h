// Directions of the guided methods for a vector of paths. Included by one file per instruction set; see lanes.h.
#pragma once

#include "cpu/lane_kernels.h"
#include "cpu/lanes.h"
#include "cpu/philox_lanes.h"

namespace pl {
namespace {

/// Some lanes of a group of paths, step by step: each step asks for the memory of the next one, which has come when all
/// other paths have taken theirs. Tables are larger than the caches.
class GuidedLanes {
public:
    PL_INLINE GuidedLanes(const GuidedMixture& mixture, const GuidedGroup& paths, std::uint32_t first)
        : mixture_(mixture), first_(first),
          paths_(paths), place_{{load_lanes<LaneInt>(paths.volume + first), vector(paths.site),
                                 vector(paths.volume_normal), row(paths.inverse_reach), row(paths.bsdf_fraction)},
                                vector(paths.position),
                                vector(paths.shading_normal)} {}

    PL_INLINE void choose_row(ChosenGroup& chosen) const {
        const LaneInt guided = mixture_.is_guided(place_, row(paths_.choice));
        const DirectionTables<Lanes> tables = mixture_.tables_of(place_, guided);
        const LaneInt table_row = select(guided, sample_row(tables, row(paths_.u_y)), LaneInt{});
        store_lanes(table_row, chosen.row + first_);
        for (int column = 0; column < mixture_.cells.side; column += kFloatsPerLine)
            Lanes::prefetch(mixture_.column_cdf, tables.first_of_row(table_row) + column);
    }

    PL_INLINE void choose_direction(const DrawKey& jitter_key, ChosenGroup& chosen) const {
        const auto draw_jitter = [&] {
            const PhiloxWords<LaneFloat> jitter = draw_lanes(jitter_key, paths_.counters, first_);
            return Real2<Lanes>{jitter.v[0], jitter.v[1]};
        };
        const Real3<Lanes> wi = mixture_.choose(place_, load_lanes<LaneInt>(chosen.row + first_), row(paths_.choice),
                                                {row(paths_.u_x), row(paths_.u_y)}, draw_jitter);
        const SeenDirection<Lanes> seen = mixture_.look(place_, wi);
        store(wi.x, chosen.direction.x);
        store(wi.y, chosen.direction.y);
        store(wi.z, chosen.direction.z);
        store(seen.table.square.x, chosen.square_x);
        store(seen.table.square.y, chosen.square_y);
        store(seen.table.cosine, chosen.cosine);
        store(seen.steradians, chosen.steradians);
        const DirectionTables<Lanes> tables = mixture_.tables_of(place_, place_.volume.number >= 0);
        const CellPair<Lanes> columns(mixture_.cells, seen.table.square.x);
        const CellPair<Lanes> rows(mixture_.cells, seen.table.square.y);
        Lanes::prefetch(mixture_.column_cdf, tables.first_of_row(rows.first) + columns.first);
        Lanes::prefetch(mixture_.column_cdf, tables.first_of_row(rows.second) + columns.first);
    }

    PL_INLINE void weigh(const ChosenGroup& chosen, DirectionGroup& directions) const {
        const GuidedDirection<Lanes> direction = mixture_.weigh(
            place_, vector(chosen.direction),
            SeenDirection<Lanes>{{Real2<Lanes>{row(chosen.square_x), row(chosen.square_y)}, row(chosen.cosine)},
                                 row(chosen.steradians)});
        store(direction.wi.x, directions.x);
        store(direction.wi.y, directions.y);
        store(direction.wi.z, directions.z);
        store(direction.pdf_sa, directions.pdf_sa);
        store(direction.bsdf_pdf_sa, directions.bsdf_pdf_sa);
        store_lanes(direction.cell, directions.cell + first_);
    }

private:
    static constexpr int kFloatsPerLine = 16;

    PL_INLINE LaneFloat row(const float* values) const { return load_lanes<LaneFloat>(values + first_); }
    PL_INLINE Real3<Lanes> vector(const VectorGroup& group) const {
        return {row(group.x), row(group.y), row(group.z)};
    }
    PL_INLINE void store(const LaneFloat& lanes, float* values) const { store_lanes(lanes, values + first_); }

    const GuidedMixture& mixture_;
    std::uint32_t first_;
    const GuidedGroup& paths_;
    GuidedPlace<Lanes> place_;
};

PL_INLINE void choose_rows_of_group(const GuidedMixture& mixture, const GuidedGroup& paths, ChosenGroup& chosen) {
    for (std::uint32_t first = 0; first < kGroupSize; first += kLaneWidth)
        GuidedLanes(mixture, paths, first).choose_row(chosen);
}

PL_INLINE void sample_guided_groups(const GuidedMixture& mixture, const DrawKey& jitter_key, const GuidedGroup* paths,
                                    ChosenGroup* chosen, DirectionGroup* directions, std::uint32_t groups) {
    for (std::uint32_t group = 0; group < groups; ++group)
        for (std::uint32_t first = 0; first < kGroupSize; first += kLaneWidth)
            GuidedLanes(mixture, paths[group], first).choose_direction(jitter_key, chosen[group]);
    for (std::uint32_t group = 0; group < groups; ++group)
        for (std::uint32_t first = 0; first < kGroupSize; first += kLaneWidth)
            GuidedLanes(mixture, paths[group], first).weigh(chosen[group], directions[group]);
}

}  // namespace
}  // namespace pl
