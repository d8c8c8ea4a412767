// Light samples and directions at vectors of Lambert reflectors: their densities and weights. Directions are sampled by the BSDF, or by a
// one-sample mixture of table and BSDF. Included by one file per instruction set; see lanes.h. Bit-identical to the steps of one path
// (core/kernel/integrator) and to Guided::sample_direction(), but both strategies of the mixture share one frame and one mapping from the
// unit square, so that lanes of different strategies do not diverge.
#pragma once

#include "core/kernel/shading/lights.h"
#include "cpu/lanes/group_rows.h"
#include "cpu/lanes/philox_lanes.h"

namespace pl {
namespace {

class VertexLanes : GroupRows {
public:
    PL_INLINE VertexLanes(const VertexGroup& vertices, std::uint32_t first) : GroupRows(first), vertices_(vertices) {}

    PL_INLINE void sample_lambert(DirectionGroup& directions) const {
        const Real3<Lanes> normal = vector(vertices_.shading_normal);
        const Real2<Lanes> u{row(vertices_.scatter.y), row(vertices_.scatter.z)};
        const Real3<Lanes> wi = make_frame(normal).to_world(square_to_cosine_hemisphere(u));
        const LaneFloat pdf_sa = cosine_pdf_sa<Lanes>(dot(wi, normal));
        store(wi, directions.wi);
        store(pdf_sa, directions.pdf_sa);
        store(pdf_sa, directions.bsdf_pdf_sa);
        store(Lanes::constant(-1), directions.bin);
    }

    PL_INLINE void weigh_lambert(const LightSampleGroup& lights, DirectionGroup& directions) const {
        store(cosine_pdf_sa<Lanes>(dot(vector(lights.wi), vector(vertices_.shading_normal))), directions.pdf_sa);
    }

    PL_INLINE void weigh_light(const DirectionGroup& directions, LightSampleGroup& samples) const {
        const Real3<Lanes> emitted = vector(samples.emitted);
        const LaneFloat pdf_sa = select(is_black(emitted), LaneFloat{}, row(samples.pdf_sa));
        const LaneFloat weight = balance_weight<Lanes>(pdf_sa, row(directions.pdf_sa)) / pdf_sa;
        const LaneFloat cos_i = row(samples.cos_i);
        const Real3<Lanes> reflectance = lambert_eval(vector(vertices_.albedo), cos_i);
        store(pdf_sa, samples.pdf_sa);
        store(weight, samples.weight);
        store(product(reflectance, emitted), samples.reflected);
        store(scaled(product(product(vector(vertices_.throughput), reflectance), emitted), weight),
              samples.contribution);
        store(rms(emitted) * (kInvPi * cos_i) * weight, samples.irradiance);
    }

    /// A path after it is scattered into a direction.
    struct Scattered {
        LaneInt is_lit;       ///< 0: f cos is 0 in the direction, or its density is
        Real3<Lanes> weight;  ///< f cos / pdf
        Real3<Lanes> origin;  ///< of the ray in the direction
    };
    PL_INLINE Scattered scatter(const DirectionGroup& directions) const {
        const Real3<Lanes> wi = vector(directions.wi);
        const LaneFloat pdf_sa = row(directions.pdf_sa);
        const Real3<Lanes> normal = vector(vertices_.geometric_normal);
        const LaneFloat cos_i = reflection_cosine(normal, vector(vertices_.shading_normal), wi);
        const SpawnPoint<Lanes> from{vector(vertices_.position), normal, row(vertices_.position_error)};
        return {(pdf_sa > 0.0f) & (cos_i != 0.0f),
                scaled(lambert_eval(vector(vertices_.albedo), cos_i), 1.0f / pdf_sa), spawn_origin(from, wi)};
    }

private:
    const VertexGroup& vertices_;
};

/// Calls step(lanes, group) for every vector of every group.
template <class Step>
PL_INLINE void for_vertex_lanes(const VertexGroup* vertices, std::uint32_t groups, const Step& step) {
    for (std::uint32_t group = 0; group < groups; ++group)
        for (std::uint32_t first = 0; first < kGroupSize; first += kLaneWidth)
            step(VertexLanes(vertices[group], first), group);
}

/// Samples directions for one vector of a group in steps. Each step prefetches the table entries of the next, since
/// tables exceed the caches; the latency is hidden by the same step of the other vectors.
class GuidedLanes : GroupRows {
public:
    PL_INLINE GuidedLanes(const TableSampler& tables, const VertexGroup& vertices, const GuidedGroup& paths,
                          std::uint32_t first)
        : GroupRows(first), tables_(tables),
          vertices_(vertices), served_{integers(paths.volume), vector(paths.site), vector(paths.volume_normal),
                                       row(paths.inverse_reach), vector(vertices.position)},
          shading_normal_(vector(vertices.shading_normal)), bsdf_fraction_(row(paths.bsdf_fraction)) {}

    PL_INLINE void sample_rows(SampledGroup& sampled) const {
        const LaneInt guided = is_guided();
        const DirectionTables<Lanes> tables = tables_of(guided);
        const LaneInt table_row = select(guided, sample_row(tables, row(vertices_.scatter.z)), LaneInt{});
        store(table_row, sampled.row);
        for (int column = 0; column < tables_.cells.side; column += kFloatsPerLine)
            Lanes::prefetch(tables_.column_cdf, tables.first_of_row(table_row) + column);
    }

    PL_INLINE void sample_direction(SampledGroup& sampled) const {
        const Real3<Lanes> wi = mixture_direction(integers(sampled.row));
        store(wi, sampled.direction);
        locate(wi, sampled);
    }

    /// Finds the cells of the directions towards lights.
    PL_INLINE void locate_light(const LightSampleGroup& lights, SampledGroup& sampled) const {
        const Real3<Lanes> wi = vector(lights.wi);
        store(wi, sampled.direction);
        locate(wi, sampled);
    }

    PL_INLINE void weigh(const SampledGroup& sampled, DirectionGroup& directions) const {
        const Real3<Lanes> wi = vector(sampled.direction);
        const TableDirection<Lanes> direction{
            {row(sampled.square_x), row(sampled.square_y)}, row(sampled.cosine), row(sampled.jacobian)};
        const LaneInt served = served_.volume >= 0;
        const TableDensity<Lanes> table =
            tables_.density<Lanes>(select(served, served_.volume, LaneInt{}), direction);
        const LaneFloat bsdf_pdf_sa = cosine_pdf_sa<Lanes>(dot(wi, shading_normal_));
        const LaneFloat a = bsdf_fraction_;
        const LaneFloat mixed = a * bsdf_pdf_sa + (1.0f - a) * table.pdf_sa;
        store(wi, directions.wi);
        store(select(served, mixed, bsdf_pdf_sa), directions.pdf_sa);
        store(bsdf_pdf_sa, directions.bsdf_pdf_sa);
        store(select(served, table.cell, Lanes::constant(-1)), directions.bin);
    }

private:
    static constexpr int kFloatsPerLine = 16;

    /// Finds the directions in their tables.
    PL_INLINE void locate(const Real3<Lanes>& wi, SampledGroup& sampled) const {
        const TableDirection<Lanes> direction = tables_.locate(served_, wi);
        store(direction.square.x, sampled.square_x);
        store(direction.square.y, sampled.square_y);
        store(direction.cosine, sampled.cosine);
        store(direction.jacobian, sampled.jacobian);
        const DirectionTables<Lanes> tables = tables_of(served_.volume >= 0);
        const CellPair<Lanes> columns(tables_.cells, direction.square.x);
        const CellPair<Lanes> rows(tables_.cells, direction.square.y);
        Lanes::prefetch(tables_.column_cdf, tables.first_of_row(rows.first) + columns.first);
        Lanes::prefetch(tables_.column_cdf, tables.first_of_row(rows.second) + columns.first);
    }

    /// Mask of the lanes that sample the table rather than the BSDF.
    PL_INLINE LaneInt is_guided() const {
        return (served_.volume >= 0) & (row(vertices_.scatter.x) >= bsdf_fraction_);
    }
    /// The table of each lane's volume; of volume 0 in lanes outside the mask.
    PL_INLINE DirectionTables<Lanes> tables_of(const LaneInt& wanted) const {
        return tables_.tables_of<Lanes>(select(wanted, served_.volume, LaneInt{}));
    }
    PL_INLINE Real3<Lanes> mixture_direction(const LaneInt& table_row) const {
        const LaneInt guided = is_guided();
        const Real2<Lanes> u{row(vertices_.scatter.y), row(vertices_.scatter.z)};
        Real2<Lanes> square = u;
        if (Lanes::any(guided)) square = select(guided, sample_square(tables_of(guided), table_row, u), u);
        const FrameOf<Lanes> frame = make_frame(select(guided, served_.normal, shading_normal_));
        const Real3<Lanes> direction = frame.to_world(square_to_cosine_hemisphere(square));
        return select(guided, TableSampler::parallax_of(served_).to_point(direction), direction);
    }

    const TableSampler& tables_;
    const VertexGroup& vertices_;
    ServedPoint<Lanes> served_;
    Real3<Lanes> shading_normal_;
    LaneFloat bsdf_fraction_;  ///< a, in (0, 1]
};

/// Calls step(lanes, group) for every vector of every group.
template <class Step>
PL_INLINE void for_guided_lanes(const TableSampler& tables, const VertexGroup* vertices, const GuidedGroup* paths,
                                std::uint32_t groups, const Step& step) {
    for (std::uint32_t group = 0; group < groups; ++group)
        for (std::uint32_t first = 0; first < kGroupSize; first += kLaneWidth)
            step(GuidedLanes(tables, vertices[group], paths[group], first), group);
}

void sample_rows(const TableSampler& tables, const VertexGroup& vertices, const GuidedGroup& paths,
                 SampledGroup& sampled) {
    for_guided_lanes(tables, &vertices, &paths, 1,
                     [&](const GuidedLanes& lanes, std::uint32_t) { lanes.sample_rows(sampled); });
}

void weigh_guided(const TableSampler& tables, const VertexGroup* vertices, const GuidedGroup* paths,
                  const LightSampleGroup* lights, DirectionGroup* directions, std::uint32_t groups) {
    SampledGroup sampled[kBlockGroups];
    for_guided_lanes(tables, vertices, paths, groups, [&](const GuidedLanes& lanes, std::uint32_t group) {
        lanes.locate_light(lights[group], sampled[group]);
    });
    for_guided_lanes(tables, vertices, paths, groups, [&](const GuidedLanes& lanes, std::uint32_t group) {
        lanes.weigh(sampled[group], directions[group]);
    });
}

void sample_guided(const TableSampler& tables, const VertexGroup* vertices, const GuidedGroup* paths,
                   SampledGroup* sampled, DirectionGroup* directions, std::uint32_t groups) {
    for_guided_lanes(tables, vertices, paths, groups,
                     [&](const GuidedLanes& lanes, std::uint32_t group) { lanes.sample_direction(sampled[group]); });
    for_guided_lanes(tables, vertices, paths, groups, [&](const GuidedLanes& lanes, std::uint32_t group) {
        lanes.weigh(sampled[group], directions[group]);
    });
}

void sample_lambert(const VertexGroup* vertices, DirectionGroup* directions, std::uint32_t groups) {
    for_vertex_lanes(vertices, groups,
                     [&](const VertexLanes& lanes, std::uint32_t group) { lanes.sample_lambert(directions[group]); });
}

void weigh_lambert(const VertexGroup* vertices, const LightSampleGroup* lights, DirectionGroup* directions,
                   std::uint32_t groups) {
    for_vertex_lanes(vertices, groups, [&](const VertexLanes& lanes, std::uint32_t group) {
        lanes.weigh_lambert(lights[group], directions[group]);
    });
}

void weigh_lights(const VertexGroup* vertices, const DirectionGroup* directions, LightSampleGroup* samples,
                  std::uint32_t groups) {
    for_vertex_lanes(vertices, groups, [&](const VertexLanes& lanes, std::uint32_t group) {
        lanes.weigh_light(directions[group], samples[group]);
    });
}

}  // namespace
}  // namespace pl
