// Light samples for a vector of receivers: on emissive triangles, and of an environment map and a sun. Included by one file per
// instruction set; see lanes.h. Bit-identical to sample_direct_light() and, at Lambert reflectors, to far_light_from(); samples of far
// lights to sample_far().
#pragma once

#include "cpu/lanes/group_rows.h"

namespace pl {
namespace {

/// Samples of emissive triangles.
class LightLanes : GroupRows {
public:
    PL_INLINE LightLanes(const LightRows& lights, const VertexGroup& receivers, std::uint32_t first)
        : GroupRows(first), lights_(lights), receivers_(receivers) {}

    /// A point on a light that is chosen by power.
    PL_INLINE void sample_by_power(LightSampleGroup& samples) const {
        const LaneInt number = choose_by_power();
        const Words<LightRecord> light(lights_.lights, number);
        const Real3<Lanes> emission = light.vector(offsetof(LightRecord, emission));
        const LaneFloat pdf_area = luminance_of(emission.x, emission.y, emission.z) / lights_.power;
        sample(light, emission, lights_.power > 0.0f ? pdf_area : LaneFloat{}, samples);
    }

    /// A point on the light that was chosen.
    PL_INLINE void sample_chosen(LightSampleGroup& samples) const {
        const Words<LightRecord> light(lights_.lights, integers(samples.light));
        sample(light, light.vector(offsetof(LightRecord, emission)), row(samples.pdf_area), samples);
    }

private:
    /// find_interval() in lanes: counts the lights but the last whose cumulative probability is not above u.
    PL_INLINE LaneInt choose_by_power() const {
        const LaneFloat u = row(receivers_.light.rows[0]);
        LaneInt light{};
        for (std::uint32_t i = 0; i + 1 < lights_.count; ++i)
            light -= broadcast(lights_.lights[i].cumulative_probability) <= u;  // true is -1
        return light;
    }

    PL_INLINE void sample(const Words<LightRecord>& light, const Real3<Lanes>& emission, const LaneFloat& pdf_area,
                          LightSampleGroup& samples) const {
        constexpr std::size_t kCorners = offsetof(LightRecord, corners);
        const CornersOf<Lanes> corners{light.vector(kCorners), light.vector(kCorners + sizeof(Vec3f)),
                                       light.vector(kCorners + 2 * sizeof(Vec3f))};
        const Real3<Lanes> normal = light.vector(offsetof(LightRecord, normal));
        const LaneInt primitive = light.integer(offsetof(LightRecord, primitive));
        const SpawnPoint<Lanes> from{vector(receivers_.position), vector(receivers_.geometric_normal),
                                     row(receivers_.position_error)};
        const Real3<Lanes> origin = spawn_origin(from, from.normal);
        const TriangleSample<Lanes> sampled =
            sample_triangle(see_triangle(corners, origin),
                            Real2<Lanes>{row(receivers_.light.rows[1]), row(receivers_.light.rows[2])});
        const LaneInt is_near = sampled.area_per_steradian > 0.0f;
        const Real3<Lanes> seen_from = select(is_near, origin, from.position);
        SpawnPoint<Lanes> point{corners.at(sampled.weights), normal,
                                light.real(offsetof(LightRecord, position_error))};
        const LaneInt behind = is_behind(point, seen_from);
        point.normal = select(behind, -normal, normal);

        const Real3<Lanes> segment = point.position - seen_from;
        const LaneFloat distance2 = dot(segment, segment);
        const Real3<Lanes> wi = scaled(segment, 1.0f / Lanes::sqrt(distance2));
        const LaneFloat cos_i = reflection_cosine(from.normal, vector(receivers_.shading_normal), wi);
        const LaneFloat pdf_sa = select(is_near, pdf_area * sampled.area_per_steradian,
                                        per_steradian<Lanes>(pdf_area, from.position, point, wi));
        const LaneInt is_seen = (distance2 > 0.0f) & (primitive != integers(receivers_.primitive));
        const LaneFloat seen_pdf_sa = select(is_seen, pdf_sa, LaneFloat{});
        const RaySegment<Lanes> shadow = spawn_segment(from, point);

        store(behind, samples.is_behind);
        store(cos_i, samples.cos_i);
        store(seen_pdf_sa, samples.seen_pdf_sa);
        store(select(cos_i > 0.0f, seen_pdf_sa, LaneFloat{}), samples.pdf_sa);
        store(sampled.weights, samples.weights);
        store(wi, samples.wi);
        store(select(behind, light.vector(offsetof(LightRecord, back_emission)), emission), samples.emitted);
        store(primitive, samples.target);
        store(shadow.origin, samples.origin);
        store(shadow.direction, samples.direction);
    }

    const LightRows& lights_;
    const VertexGroup& receivers_;
};

/// Calls step(lanes, group) for every vector of every group.
template <class Step>
PL_INLINE void for_light_lanes(const LightRows& lights, const VertexGroup* receivers, std::uint32_t groups,
                               const Step& step) {
    for (std::uint32_t group = 0; group < groups; ++group)
        for (std::uint32_t first = 0; first < kGroupSize; first += kLaneWidth)
            step(LightLanes(lights, receivers[group], first), group);
}

/// Samples of an environment map and a sun.
class FarLightLanes : GroupRows {
public:
    PL_INLINE FarLightLanes(const FarRows& lights, const VertexGroup& receivers, std::uint32_t first)
        : GroupRows(first), lights_(lights), receivers_(receivers) {}

    /// Keeps the samples of all lanes in `far`, and makes light samples in those that choose far lights.
    PL_INLINE void sample(FarSampleGroup& far, LightSampleGroup& samples) const {
        const NumberGroup& numbers = receivers_.light;
        const LaneInt chosen = row(numbers.rows[3]) < lights_.probability;
        if (!Lanes::any(chosen)) return;
        const FarSampleOf<Lanes> sample = sample_far<Lanes>(
            *lights_.lights, Real2<Lanes>{row(numbers.rows[0]), row(numbers.rows[1])}, row(numbers.rows[2]));
        store(sample.wi, far.wi);
        store(sample.radiance, far.radiance);
        store(sample.pdf_sa, far.pdf_sa);
        reflect(sample, chosen, samples);
    }

private:
    PL_INLINE void reflect(const FarSampleOf<Lanes>& sample, const LaneInt& chosen, LightSampleGroup& samples) const {
        const Real3<Lanes> normal = vector(receivers_.geometric_normal);
        const LaneFloat cos_i = reflection_cosine(normal, vector(receivers_.shading_normal), sample.wi);
        const Real3<Lanes>& emitted = sample.radiance;
        const LaneInt shines = (emitted.x != 0.0f) | (emitted.y != 0.0f) | (emitted.z != 0.0f);
        const LaneFloat pdf_sa = lights_.probability * sample.pdf_sa;
        const SpawnPoint<Lanes> from{vector(receivers_.position), normal, row(receivers_.position_error)};
        replace(samples.cos_i, chosen, cos_i);
        replace(samples.pdf_sa, chosen, select((cos_i > 0.0f) & shines, pdf_sa, LaneFloat{}));
        replace(samples.wi, chosen, sample.wi);
        replace(samples.emitted, chosen, emitted);
        replace(samples.target, chosen, Lanes::constant(static_cast<std::int32_t>(kNoPrimitive)));
        replace(samples.cluster, chosen, Lanes::constant(static_cast<std::int32_t>(kNoCluster)));
        replace(samples.origin, chosen, spawn_origin(from, sample.wi));
        replace(samples.direction, chosen, sample.wi);
    }
    template <class T>
    PL_INLINE void replace(T* values, const LaneInt& lanes, const LaneInt& by) const {
        store(select(lanes, by, integers(values)), values);
    }
    PL_INLINE void replace(float* values, const LaneInt& lanes, const LaneFloat& by) const {
        store(select(lanes, by, row(values)), values);
    }
    PL_INLINE void replace(VectorGroup& values, const LaneInt& lanes, const Real3<Lanes>& by) const {
        store(select(lanes, by, vector(values)), values);
    }

    const FarRows& lights_;
    const VertexGroup& receivers_;
};

}  // namespace
}  // namespace pl
