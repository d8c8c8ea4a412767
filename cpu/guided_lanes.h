// One-sample mixture of table and Lambert BSDF for a vector of paths. Included by one file per instruction set; see
// lanes.h. Bit-identical to Guided::sample_direction(), but both strategies share one frame and one mapping from the
// unit square, so that lanes of different strategies do not diverge.
#pragma once

#include "cpu/lane_kernels.h"
#include "cpu/lanes.h"
#include "cpu/philox_lanes.h"

namespace pl {
namespace {

/// Samples directions for one vector of a group in steps. Each step prefetches the table entries of the next, since
/// tables exceed the caches; the latency is hidden by the same step of the other vectors.
class GuidedLanes {
public:
    PL_INLINE GuidedLanes(const TableSampler& tables, const GuidedGroup& paths, std::uint32_t first)
        : tables_(tables), first_(first),
          paths_(paths), point_{{load_lanes<LaneInt>(paths.volume + first), vector(paths.site),
                                 vector(paths.volume_normal), row(paths.inverse_reach), vector(paths.position)},
                                vector(paths.shading_normal),
                                row(paths.bsdf_fraction)} {}

    PL_INLINE void sample_rows(SampledGroup& sampled) const {
        const LaneInt guided = is_guided();
        const DirectionTables<Lanes> tables = tables_of(guided);
        const LaneInt table_row = select(guided, sample_row(tables, row(paths_.u_y)), LaneInt{});
        store_lanes(table_row, sampled.row + first_);
        for (int column = 0; column < tables_.cells.side; column += kFloatsPerLine)
            Lanes::prefetch(tables_.column_cdf, tables.first_of_row(table_row) + column);
    }

    PL_INLINE void sample_direction(SampledGroup& sampled) const {
        const Real3<Lanes> wi = mixture_direction(load_lanes<LaneInt>(sampled.row + first_));
        store(wi.x, sampled.direction.x);
        store(wi.y, sampled.direction.y);
        store(wi.z, sampled.direction.z);
        locate(wi, sampled);
    }

    /// The same for directions that come in `sampled`.
    PL_INLINE void locate_direction(SampledGroup& sampled) const { locate(vector(sampled.direction), sampled); }

    PL_INLINE void weigh(const SampledGroup& sampled, DirectionGroup& directions) const {
        const Real3<Lanes> wi = vector(sampled.direction);
        const TableDirection<Lanes> direction{
            {row(sampled.square_x), row(sampled.square_y)}, row(sampled.cosine), row(sampled.jacobian)};
        const LaneInt served = point_.served.volume >= 0;
        const TableDensity<Lanes> table =
            tables_.density<Lanes>(select(served, point_.served.volume, LaneInt{}), direction);
        const LaneFloat bsdf_pdf_sa = cosine_pdf_sa<Lanes>(dot(wi, point_.shading_normal));
        const LaneFloat a = point_.bsdf_fraction;
        const LaneFloat mixed = a * bsdf_pdf_sa + (1.0f - a) * table.pdf_sa;
        store(wi.x, directions.x);
        store(wi.y, directions.y);
        store(wi.z, directions.z);
        store(select(served, mixed, bsdf_pdf_sa), directions.pdf_sa);
        store(bsdf_pdf_sa, directions.bsdf_pdf_sa);
        store_lanes(select(served, table.cell, Lanes::constant(-1)), directions.bin + first_);
    }

private:
    static constexpr int kFloatsPerLine = 16;

    /// Finds the directions in their tables.
    PL_INLINE void locate(const Real3<Lanes>& wi, SampledGroup& sampled) const {
        const TableDirection<Lanes> direction = tables_.locate(point_.served, wi);
        store(direction.square.x, sampled.square_x);
        store(direction.square.y, sampled.square_y);
        store(direction.cosine, sampled.cosine);
        store(direction.jacobian, sampled.jacobian);
        const DirectionTables<Lanes> tables = tables_of(point_.served.volume >= 0);
        const CellPair<Lanes> columns(tables_.cells, direction.square.x);
        const CellPair<Lanes> rows(tables_.cells, direction.square.y);
        Lanes::prefetch(tables_.column_cdf, tables.first_of_row(rows.first) + columns.first);
        Lanes::prefetch(tables_.column_cdf, tables.first_of_row(rows.second) + columns.first);
    }

    /// Mask of the lanes that sample the table rather than the BSDF.
    PL_INLINE LaneInt is_guided() const {
        return (point_.served.volume >= 0) & (row(paths_.choice) >= point_.bsdf_fraction);
    }
    /// The table of each lane's volume; of volume 0 in lanes outside the mask.
    PL_INLINE DirectionTables<Lanes> tables_of(const LaneInt& wanted) const {
        return tables_.tables_of<Lanes>(select(wanted, point_.served.volume, LaneInt{}));
    }
    PL_INLINE Real3<Lanes> mixture_direction(const LaneInt& table_row) const {
        const LaneInt guided = is_guided();
        const Real2<Lanes> u{row(paths_.u_x), row(paths_.u_y)};
        Real2<Lanes> square = u;
        if (Lanes::any(guided)) square = select(guided, sample_square(tables_of(guided), table_row, u), u);
        const FrameOf<Lanes> frame = make_frame(select(guided, point_.served.normal, point_.shading_normal));
        const Real3<Lanes> direction = frame.to_world(square_to_cosine_hemisphere(square));
        return select(guided, TableSampler::parallax_of(point_.served).to_point(direction), direction);
    }

    PL_INLINE LaneFloat row(const float* values) const { return load_lanes<LaneFloat>(values + first_); }
    PL_INLINE Real3<Lanes> vector(const VectorGroup& group) const {
        return {row(group.x), row(group.y), row(group.z)};
    }
    PL_INLINE void store(const LaneFloat& lanes, float* values) const { store_lanes(lanes, values + first_); }

    const TableSampler& tables_;
    std::uint32_t first_;
    const GuidedGroup& paths_;
    MixturePoint<Lanes> point_;
};

PL_INLINE void sample_rows_of_group(const TableSampler& tables, const GuidedGroup& paths, SampledGroup& sampled) {
    for (std::uint32_t first = 0; first < kGroupSize; first += kLaneWidth)
        GuidedLanes(tables, paths, first).sample_rows(sampled);
}

PL_INLINE void weigh_guided_groups(const TableSampler& tables, const GuidedGroup* paths, SampledGroup* sampled,
                                   DirectionGroup* directions, std::uint32_t groups) {
    for (std::uint32_t group = 0; group < groups; ++group)
        for (std::uint32_t first = 0; first < kGroupSize; first += kLaneWidth)
            GuidedLanes(tables, paths[group], first).locate_direction(sampled[group]);
    for (std::uint32_t group = 0; group < groups; ++group)
        for (std::uint32_t first = 0; first < kGroupSize; first += kLaneWidth)
            GuidedLanes(tables, paths[group], first).weigh(sampled[group], directions[group]);
}

PL_INLINE void sample_guided_groups(const TableSampler& tables, const GuidedGroup* paths, SampledGroup* sampled,
                                    DirectionGroup* directions, std::uint32_t groups) {
    for (std::uint32_t group = 0; group < groups; ++group)
        for (std::uint32_t first = 0; first < kGroupSize; first += kLaneWidth)
            GuidedLanes(tables, paths[group], first).sample_direction(sampled[group]);
    for (std::uint32_t group = 0; group < groups; ++group)
        for (std::uint32_t first = 0; first < kGroupSize; first += kLaneWidth)
            GuidedLanes(tables, paths[group], first).weigh(sampled[group], directions[group]);
}

}  // namespace
}  // namespace pl
