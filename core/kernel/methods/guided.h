// The guided method: a one-sample mixture of BSDF and guiding field, whose paths train the field by a target. Field and target
// are its two parameters.
#pragma once

#include "core/kernel/guiding/guiding_field.h"
#include "core/kernel/guiding/mixture.h"
#include "core/kernel/methods/method.h"

namespace pl {

/// The common part of all targets: a field, and training samples for it.
template <GuidingField F>
struct FieldTrainer : MethodHooks {
    using Field = F;
    using Vertex = typename Field::Location;

    Field field;
    MixtureSettings mixture{};
    bool trains = true;  ///< whether paths make training samples

    /// The training sample opened by a scattered direction; none if it trains no entry of the field.
    PL_HD OpenSample<Field> open_sample(const Vertex& vertex, const DirectionSample& direction) const {
        if (!trains) return {};
        const typename Field::Entry entry = field.entry_of(vertex, direction);
        if (!entry.is_trained()) return {};
        return {entry, direction.bsdf_pdf_sa / direction.pdf_sa};
    }
    PL_HD void count_sample(float target, MethodCounters& counters) const {
        ++counters.records;
        counters.clamped_records += field.is_clamped(target) ? 1u : 0u;
    }
    /// Adds a training sample to the field, if there is one.
    PL_HD void train(const OpenSample<Field>& open, float target) const {
        if (open.entry.is_trained()) field.record({open, target}, mixture.learned != 0);
    }
};

/// Radiance `expected` of a path from its vertex on as a share of the radiance expected at its first vertex. Infinite
/// or NaN, and then `otherwise`, if the first expectation is 0 or the ratio is beyond the range of float.
template <class N>
PL_INLINE typename N::Real expected_share(const typename N::Real& expected, const typename N::Real& first,
                                          const typename N::Real& otherwise) {
    const auto estimate = expected / first;
    return select(static_cast<typename N::Mask>(estimate < kInfinity), estimate, otherwise);
}

/// q = a p_bsdf + (1-a) p_field; both densities are evaluated, whichever of the two sampled the direction. A direction weighs
/// at most 1/a times its weight under BSDF sampling.   [Veach 1997, 9.2.4; Mueller et al. 2017]
/// `Target` makes training samples of a path: targets/expected_sarsa.h, sarsa.h, monte_carlo.h, or frozen.h for none.
template <GuidingField F, template <class> class Target>
struct Guided : Target<F> {
    using typename Target<F>::Vertex;
    /// Radiance, rms() of its channels, expected to be reflected at the path's first vertex with a location, light samples included; 0
    /// before it.
    using Expectation = float;
    using Target<F>::field;
    using Target<F>::mixture;

    PL_HD Vertex locate(const SurfacePoint& surface, MethodCounters& counters) const {
        return count_lookup(field.locate(surface), counters);
    }
    static PL_HD Vertex count_lookup(const Vertex& vertex, MethodCounters& counters) {
        ++counters.lookups;
        counters.lookup_misses += vertex.is_served() ? 0u : 1u;
        return vertex;
    }

    PL_HD DirectionSample sample_direction(const Vertex& vertex, const SurfacePoint& surface,
                                           const ScatterUniforms& uniforms) const {
        const bool from_field = vertex.is_served() && samples_field(vertex, uniforms);
        const Vec3f wi = from_field ? field.sample(vertex, surface, uniforms)
                                    : lambert_sample(surface, {uniforms.u.y, uniforms.u.z});
        return weigh(vertex, surface, wi);
    }
    PL_HD float pdf_sa(const Vertex& vertex, const SurfacePoint& surface, Vec3f wi) const {
        return weigh(vertex, surface, wi).pdf_sa;
    }
    template <FeatureSet B>
    PL_HD DirectionSample sample_direction(const Vertex& vertex, const SurfacePoint& surface,
                                           const LayeredBsdf<B>& bsdf, const ScatterUniforms& uniforms) const {
        if (!vertex.is_served()) return sample_bsdf(surface, bsdf, uniforms);
        const Vec3f wi = samples_field(vertex, uniforms)
                             ? field.sample(vertex, surface, uniforms)
                             : bsdf.sample(surface, {uniforms.u.y, uniforms.u.z}, uniforms.lobe);
        return mix(vertex, surface, wi, bsdf.pdf_sa(surface, wi));
    }
    template <FeatureSet B>
    PL_HD float pdf_sa(const Vertex& vertex, const SurfacePoint& surface, const LayeredBsdf<B>& bsdf,
                       Vec3f wi) const {
        const float bsdf_pdf_sa = bsdf.pdf_sa(surface, wi);
        return vertex.is_served() ? mix(vertex, surface, wi, bsdf_pdf_sa).pdf_sa : bsdf_pdf_sa;
    }

    /// From the learned radiance: a direction guided towards light has a low throughput but a high expected radiance,
    /// so roulette does not end it for its throughput, while it ends one into the dark.
    /// [after Vorba and Krivanek 2016, "Adjoint-Driven Russian Roulette and Splitting in Light Transport Simulation"]
    PL_HD float estimate_contribution(const Vertex& vertex, Vec3f albedo, Vec3f throughput, float survival,
                                      Expectation& first) const {
        if (!vertex.is_served()) return survival;
        const float expected = rms(throughput * albedo) * field.value_at(vertex);
        if (first == 0.0f) first = expected + rms(throughput * albedo) * field.direct_at(vertex);
        return expected_share<One>(expected, first, survival);
    }

    /// The fraction a of the mixture at a served vertex.
    PL_HD float bsdf_fraction(const Vertex& vertex) const {
        return mixture.learned != 0 ? field.bsdf_fraction_at(vertex) : mixture.bsdf_fraction;
    }

    /// Learned choice of lights at a vertex.
    PL_HD LearnedLights learned_lights(const Vertex& vertex) const {
        return vertex.is_served() && mixture.learned_lights != 0 ? field.lights_at(vertex) : LearnedLights{};
    }

private:
    PL_HD bool samples_field(const Vertex& vertex, const ScatterUniforms& uniforms) const {
        return uniforms.u.x >= bsdf_fraction(vertex);
    }
    PL_HD DirectionSample weigh(const Vertex& vertex, const SurfacePoint& surface, Vec3f wi) const {
        if (!vertex.is_served()) return weigh_lambert(surface, wi);
        return mix(vertex, surface, wi, lambert_pdf_sa(surface, wi));
    }
    PL_HD DirectionSample mix(const Vertex& vertex, const SurfacePoint& surface, Vec3f wi, float bsdf_pdf_sa) const {
        const FieldDensity density = field.density(vertex, surface, wi);
        const float a = bsdf_fraction(vertex);
        return {wi, a * bsdf_pdf_sa + (1.0f - a) * density.pdf_sa, bsdf_pdf_sa, density.bin};
    }
};

/// Whether M guides paths by a field.
template <class M>
concept GuidedMethod = Method<M> && GuidingField<typename M::Field>;

}  // namespace pl
