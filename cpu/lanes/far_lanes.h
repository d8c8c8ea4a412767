// Samples of an environment map and a sun for vectors of receivers. Included by one file per instruction set; see lanes.h. Bit-identical
// to sample_far(), and at Lambert reflectors to far_light_from().
#pragma once

#include "cpu/lanes/group_rows.h"

namespace pl {
namespace {

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
