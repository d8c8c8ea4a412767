// Light samples at a vertex: sampled, reflected and weighed by multiple importance sampling.
#pragma once

#include "core/kernel/integrator/medium.h"
#include "core/kernel/integrator/scatter.h"
#include "core/kernel/shading/lights.h"

namespace pl {

/// A light sample that contributes if nothing occludes the light, before its MIS weight is known.
struct UnweightedLight {
    Ray ray;                             ///< the shadow ray
    Vec3f wi{0.0f};                      ///< unit, towards the light
    float pdf_sa = 0.0f;                 ///< of light sampling; 0: the sample cannot contribute
    Vec3f contribution{0.0f};            ///< times pdf_sa, without the weight; so are the next two
    Vec3f reflected{0.0f};               ///< LightEstimate::reflected
    float irradiance = 0.0f;             ///< LightEstimate::irradiance
    std::uint32_t cluster = kNoCluster;  ///< LightEstimate::cluster
};

/// Weights of the light that a path receives at a vertex, before the roulette there.
struct ReceivedWeights {
    Vec3f throughput{1.0f};
    Vec3f chain{1.0f};                 ///< of the specular chain that ends at the vertex; with lobes only
    std::uint32_t medium = kNoMedium;  ///< around the path there
};
template <FeatureSet F, class M>
PL_HD inline ReceivedWeights received_weights(const PathState<F, M>& state) {
    ReceivedWeights weights{.throughput = state.throughput, .medium = medium_of(state)};
    if constexpr (F.has_any(kLobeFeatures)) weights.chain = state.chain.weight;
    return weights;
}

/// The reflection at a vertex of a light sample that can contribute, through the shadow ray `ray`. `emitted`: its radiance, less
/// absorption on the way.
template <FeatureSet F, class M>
PL_HD inline UnweightedLight reflect_light(const ScatterPoint<F, M>& from, const DirectLight& sample, Vec3f emitted,
                                           const Ray& ray, const ReceivedWeights& weights) {
    const Vec3f reflectance = from.bsdf.eval(from.surface, sample.wi, sample.cos_i);
    UnweightedLight light{.ray = ray, .wi = sample.wi, .pdf_sa = sample.pdf_sa};
    light.cluster = sample.cluster;
    light.contribution = weights.throughput * reflectance * emitted;
    light.reflected = reflectance * emitted;
    light.irradiance = rms(emitted) * (kInvPi * sample.cos_i);
    if constexpr (F.has_any(kLobeFeatures)) {
        // The radiance of a specular chain is the radiance from its scattered directions.
        light.reflected = from.bsdf.is_specular() ? Vec3f{0.0f} : weights.chain * light.reflected;
    }
    return light;
}

/// The reflection at a vertex of a light sample that can contribute, through the glass around the path. `ray`: shadow_ray_to().
template <FeatureSet F, Method M>
PL_HD_INLINED UnweightedLight unweighted_light(const PathContext<M>& context, const ScatterPoint<F, M>& from,
                                               const DirectLight& sample, const Ray& ray,
                                               const ReceivedWeights& weights) {
    Vec3f emitted = sample.emitted;
    if constexpr (kTracksMedium<F>) {
        const std::uint32_t medium = medium_towards(from.surface, from.bsdf, sample.wi, weights.medium);
        emitted *= shadow_transmittance(context.scene, medium, ray);
    }
    return reflect_light(from, sample, emitted, ray, weights);
}

/// Samples a light at a vertex, by the numbers `u`.
template <FeatureSet F, Method M>
PL_HD_INLINED UnweightedLight sample_light(const PathContext<M>& context, const ScatterPoint<F, M>& from, Vec4f u,
                                           const ReceivedWeights& weights) {
    const LearnedLights learned = learned_lights<F>(context.method, from.vertex);
    const DirectLight sample = sample_direct_light<F>(context.scene, from.surface, from.bsdf, u, learned);
    if (!(sample.pdf_sa > 0.0f)) return {};
    return unweighted_light(context, from, sample, shadow_ray_to<F>(from.surface, sample), weights);
}

/// Weighs a light sample by multiple importance sampling. `scatter_pdf_sa`: of its direction, see scatter_pdf_sa(). `shadow` comes
/// in cleared; `shadow.wanted` stays false if the sample cannot contribute.
template <FeatureSet F, Method M>
PL_HD_INLINED void weigh_light(const M& method, const typename M::Vertex& vertex, const UnweightedLight& light,
                               float scatter_pdf_sa, PathState<F, M>& state, ShadowRequest<M>& shadow) {
    LightEstimate estimate;
    if (light.pdf_sa > 0.0f) {
        const float weight = balance_weight(light.pdf_sa, scatter_pdf_sa) / light.pdf_sa;
        shadow.ray = light.ray;
        shadow.contribution = light.contribution * weight;
        shadow.wanted = true;
        estimate = {light.reflected * weight, light.irradiance * weight, light.cluster};
    }
    shadow.light = method.light_sampled(state.memory, vertex, estimate);
}

/// Weighs a light sample at a vertex.
template <FeatureSet F, Method M>
PL_HD_INLINED void weigh_light(const M& method, const ScatterPoint<F, M>& from, const UnweightedLight& light,
                               PathState<F, M>& state, ShadowRequest<M>& shadow) {
    const float pdf_sa = light.pdf_sa > 0.0f ? scatter_pdf_sa(method, from, light.wi) : 0.0f;
    weigh_light<F>(method, from.vertex, light, pdf_sa, state, shadow);
}

/// Samples a light at a vertex, if the settings ask for it.
template <FeatureSet F, Method M>
PL_HD_INLINED void request_light(const PathContext<M>& context, const ScatterPoint<F, M>& from, Vec4f u,
                                 PathState<F, M>& state, ShadowRequest<M>& shadow) {
    if constexpr (F.has(Feature::NextEventEstimation)) {
        if (context.settings.next_event == 0) return;
        weigh_light(context.method, from, sample_light(context, from, u, received_weights(state)), state, shadow);
    }
}

}  // namespace pl
