// Light samples and directions at vectors of Lambert reflectors: their densities and weights. Included by one file per instruction
// set; see lanes.h. Bit-identical to the steps of one path (core/kernel/integrator).
#pragma once

#include "core/kernel/shading/lights.h"
#include "cpu/lanes/group_rows.h"

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

    /// Members as in ScatteredGroup.
    struct Scattered {
        LaneInt is_lit;
        Real3<Lanes> weight, origin;
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
    PL_INLINE void scatter(const DirectionGroup& directions, ScatteredGroup& to) const {
        const Scattered scattered = scatter(directions);
        store(scattered.is_lit, to.is_lit);
        store(scattered.weight, to.weight);
        store(scattered.origin, to.origin);
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

}  // namespace
}  // namespace pl
