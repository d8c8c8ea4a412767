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

    /// sample_texel() in three steps, each of which asks for the memory of the next one: the searches of many vectors wait together.
    PL_INLINE void choose_row(SampledTexelOf<Lanes>& texel) const {
        if (!Lanes::any(chosen())) return;
        texel.row = sample_cdf<Lanes>(map().rows, LaneInt{}, u().y);
        Lanes::prefetch(map().columns.index.data, bucket_of<Lanes>(map().columns, texel.row.entry, u().x));
    }
    PL_INLINE void find_columns(const SampledTexelOf<Lanes>& texel) const {
        if (!Lanes::any(chosen())) return;
        const IndexedCdf& columns = map().columns;
        const LaneInt begin = Lanes::load(columns.index.data, bucket_of<Lanes>(columns, texel.row.entry, u().x));
        Lanes::prefetch(columns.values.data, texel.row.entry * static_cast<std::int32_t>(columns.count) + begin);
    }
    PL_INLINE void choose_column(SampledTexelOf<Lanes>& texel) const {
        if (!Lanes::any(chosen())) return;
        texel.column = sample_cdf<Lanes>(map().columns, texel.row.entry, u().x);
        const LaneInt next =
            texel.row.entry + select(texel.row.position < 0.5f, Lanes::constant(-1), Lanes::constant(1));
        const LaneInt other = clamp_int<Lanes>(next, 0, static_cast<std::int32_t>(map().height) - 1);
        for (const LaneInt& row : {texel.row.entry, other})
            Lanes::prefetch(map().texels.data,
                            4 * (row * static_cast<std::int32_t>(map().width) + texel.column.entry));
    }

    /// Keeps the samples of all lanes in `far`, and makes light samples in the lanes that choose far lights. `texel`:
    /// chosen before, if there is a map.
    PL_INLINE void sample(const SampledTexelOf<Lanes>& texel, FarSampleGroup& far, LightSampleGroup& samples) const {
        const LaneInt chosen = this->chosen();
        if (!Lanes::any(chosen)) return;
        const FarSampleOf<Lanes> sample =
            sample_far<Lanes>(*lights_.lights, u(), row(receivers_.light.rows[2]), [&] { return texel; });
        store(sample.wi, far.wi);
        store(sample.radiance, far.radiance);
        store(sample.pdf_sa, far.pdf_sa);
        reflect(sample, chosen, samples);
    }

private:
    PL_INLINE const EnvironmentMap& map() const { return lights_.lights->map; }
    PL_INLINE LaneInt chosen() const { return row(receivers_.light.rows[3]) < lights_.probability; }
    PL_INLINE Real2<Lanes> u() const { return {row(receivers_.light.rows[0]), row(receivers_.light.rows[1])}; }

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

void sample_lights(const LightRows& lights, const VertexGroup* vertices, LightSampleGroup* samples,
                   std::uint32_t groups) {
    for_light_lanes(lights, vertices, groups,
                    [&](const LightLanes& lanes, std::uint32_t group) { lanes.sample_by_power(samples[group]); });
}

void sample_chosen_lights(const LightRows& lights, const VertexGroup* vertices, LightSampleGroup* samples,
                          std::uint32_t groups) {
    for_light_lanes(lights, vertices, groups,
                    [&](const LightLanes& lanes, std::uint32_t group) { lanes.sample_chosen(samples[group]); });
}

void sample_far_lights(const FarRows& lights, const VertexGroup* vertices, FarSampleGroup* far,
                       LightSampleGroup* samples, std::uint32_t groups) {
    SampledTexelOf<Lanes> texels[kBlockGroups][kGroupSize / kLaneWidth];
    const auto for_lanes = [&](const auto& step) {
        for (std::uint32_t group = 0; group < groups; ++group)
            for (std::uint32_t i = 0; i < kGroupSize / kLaneWidth; ++i)
                step(FarLightLanes(lights, vertices[group], i * kLaneWidth), texels[group][i], group);
    };
    using Texel = SampledTexelOf<Lanes>;
    if (!lights.lights->map.empty()) {
        for_lanes([](const FarLightLanes& lanes, Texel& texel, std::uint32_t) { lanes.choose_row(texel); });
        for_lanes([](const FarLightLanes& lanes, Texel& texel, std::uint32_t) { lanes.find_columns(texel); });
        for_lanes([](const FarLightLanes& lanes, Texel& texel, std::uint32_t) { lanes.choose_column(texel); });
    }
    for_lanes([&](const FarLightLanes& lanes, Texel& texel, std::uint32_t group) {
        lanes.sample(texel, far[group], samples[group]);
    });
}

}  // namespace
}  // namespace pl
