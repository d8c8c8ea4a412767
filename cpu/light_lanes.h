// Light samples for a vector of receivers. Included by one file per instruction set; see lanes.h. Bit-identical to
// sample_direct_light() at Lambert reflectors, for lights that are sampled over their area.
#pragma once

#include "cpu/lane_kernels.h"
#include "cpu/lanes.h"

namespace pl {
namespace {

class LightLanes {
public:
    PL_INLINE LightLanes(const LightColumns& lights, const ReceiverGroup& receivers, std::uint32_t first)
        : lights_(lights), receivers_(receivers), first_(first) {}

    PL_INLINE void sample(LightSampleGroup& samples) const {
        const LaneInt light = choose();
        const CornersOf<Lanes> corners{column(LightColumns::kCorner0, light), column(LightColumns::kCorner1, light),
                                       column(LightColumns::kCorner2, light)};
        const Real3<Lanes> normal = column(LightColumns::kNormal, light);
        const SpawnPoint<Lanes> from{vector(receivers_.position), vector(receivers_.geometric_normal),
                                     row(receivers_.position_error)};
        const LaneInt is_near = see_triangle(corners, spawn_origin(from, from.normal)).is_near();
        const Real3<Lanes> weights = sample_weights(Real2<Lanes>{row(receivers_.u[1]), row(receivers_.u[2])});
        SpawnPoint<Lanes> point{corners.at(weights), normal, number(LightColumns::kPositionError, light)};
        const LaneInt behind = is_behind(point, from.position);
        point.normal = select(behind, -normal, normal);

        const Real3<Lanes> segment = point.position - from.position;
        const LaneFloat distance2 = dot(segment, segment);
        const Real3<Lanes> wi = scaled(segment, 1.0f / Lanes::sqrt(distance2));
        const LaneFloat cos_i = reflection_cosine(from.normal, vector(receivers_.shading_normal), wi);
        const LaneFloat pdf_sa =
            per_steradian<Lanes>(number(LightColumns::kPdfArea, light), from.position, point, wi);
        const LaneInt reflects = (distance2 > 0.0f) & (cos_i > 0.0f);
        const RaySegment<Lanes> shadow = spawn_segment(from, point);

        store_lanes(light, samples.light + first_);
        store_lanes(is_near, samples.is_near + first_);
        store_lanes(behind, samples.is_behind + first_);
        store(cos_i, samples.cos_i);
        store(select(reflects, pdf_sa, LaneFloat{}), samples.pdf_sa);
        store(weights, samples.weights);
        store(wi, samples.wi);
        store(shadow.origin, samples.origin);
        store(shadow.direction, samples.direction);
    }

private:
    /// As choose_light(): the number of lights but the last whose cumulative probability is not above u.
    PL_INLINE LaneInt choose() const {
        const LaneFloat u = row(receivers_.u[0]);
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
    PL_INLINE LaneFloat row(const float* values) const { return load_lanes<LaneFloat>(values + first_); }
    PL_INLINE Real3<Lanes> vector(const VectorGroup& group) const {
        return {row(group.x), row(group.y), row(group.z)};
    }
    PL_INLINE void store(const LaneFloat& lanes, float* values) const { store_lanes(lanes, values + first_); }
    PL_INLINE void store(const Real3<Lanes>& lanes, VectorGroup& group) const {
        store(lanes.x, group.x);
        store(lanes.y, group.y);
        store(lanes.z, group.z);
    }

    const LightColumns& lights_;
    const ReceiverGroup& receivers_;
    std::uint32_t first_;
};

PL_INLINE void sample_lights_of_groups(const LightColumns& lights, const ReceiverGroup* receivers,
                                       LightSampleGroup* samples, std::uint32_t groups) {
    for (std::uint32_t group = 0; group < groups; ++group)
        for (std::uint32_t first = 0; first < kGroupSize; first += kLaneWidth)
            LightLanes(lights, receivers[group], first).sample(samples[group]);
}

}  // namespace
}  // namespace pl
