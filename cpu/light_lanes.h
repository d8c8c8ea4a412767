// Light samples for a vector of receivers. Included by one file per instruction set; see lanes.h. Bit-identical to
// sample_direct_light() at Lambert reflectors, for lights that are sampled over their area.
#pragma once

#include "cpu/group_rows.h"

namespace pl {
namespace {

class LightLanes : GroupRows {
public:
    PL_INLINE LightLanes(const LightColumns& lights, const VertexGroup& receivers, std::uint32_t first)
        : GroupRows(first), lights_(lights), receivers_(receivers) {}

    PL_INLINE void sample(LightSampleGroup& samples) const {
        const LaneInt light = choose();
        const CornersOf<Lanes> corners{column(LightColumns::kCorner0, light), column(LightColumns::kCorner1, light),
                                       column(LightColumns::kCorner2, light)};
        const Real3<Lanes> normal = column(LightColumns::kNormal, light);
        const SpawnPoint<Lanes> from{vector(receivers_.position), vector(receivers_.geometric_normal),
                                     row(receivers_.position_error)};
        const LaneInt is_near = see_triangle(corners, spawn_origin(from, from.normal)).is_near();
        const Real3<Lanes> weights =
            sample_weights(Real2<Lanes>{row(receivers_.light.rows[1]), row(receivers_.light.rows[2])});
        SpawnPoint<Lanes> point{corners.at(weights), normal, number(LightColumns::kPositionError, light)};
        const LaneInt behind = is_behind(point, from.position);
        point.normal = select(behind, -normal, normal);

        const Real3<Lanes> segment = point.position - from.position;
        const LaneFloat distance2 = dot(segment, segment);
        const Real3<Lanes> wi = scaled(segment, 1.0f / Lanes::sqrt(distance2));
        const LaneFloat cos_i = reflection_cosine(from.normal, vector(receivers_.shading_normal), wi);
        const LaneFloat pdf_sa =
            per_steradian<Lanes>(number(LightColumns::kPdfArea, light), from.position, point, wi);
        const LaneInt target = Lanes::bits_of(number(LightColumns::kPrimitive, light));
        const LaneInt is_other = target != integers(receivers_.primitive);
        const LaneInt reflects = (distance2 > 0.0f) & (cos_i > 0.0f) & is_other;
        const RaySegment<Lanes> shadow = spawn_segment(from, point);

        store(is_near, samples.is_near);
        store(behind, samples.is_behind);
        store(cos_i, samples.cos_i);
        store(select(reflects, pdf_sa, LaneFloat{}), samples.pdf_sa);
        store(weights, samples.weights);
        store(wi, samples.wi);
        store(select(behind, column(LightColumns::kBackEmission, light), column(LightColumns::kEmission, light)),
              samples.emitted);
        store(target, samples.target);
        store(shadow.origin, samples.origin);
        store(shadow.direction, samples.direction);
    }

private:
    /// As choose_light(): the number of lights but the last whose cumulative probability is not above u.
    PL_INLINE LaneInt choose() const {
        const LaneFloat u = row(receivers_.light.rows[0]);
        LaneInt light{};
        for (std::uint32_t i = 0; i + 1 < lights_.count; ++i)
            light -= broadcast(lights_.row(LightColumns::kCumulative)[i]) <= u;  // true is -1
        return light;
    }
    PL_INLINE LaneFloat number(int column, const LaneInt& light) const {
        return Lanes::load(lights_.row(column), light);
    }
    PL_INLINE Real3<Lanes> column(int first, const LaneInt& light) const {
        return {number(first, light), number(first + 1, light), number(first + 2, light)};
    }

    const LightColumns& lights_;
    const VertexGroup& receivers_;
};

PL_INLINE void sample_lights_of_groups(const LightColumns& lights, const VertexGroup* receivers,
                                       LightSampleGroup* samples, std::uint32_t groups) {
    for (std::uint32_t group = 0; group < groups; ++group)
        for (std::uint32_t first = 0; first < kGroupSize; first += kLaneWidth)
            LightLanes(lights, receivers[group], first).sample(samples[group]);
}

}  // namespace
}  // namespace pl
