// Scattering at a vertex: by a delta lobe, or into a direction that the method samples; and the end of a path there. Inlined into the
// kernels of a device: apart, the functions would take the path's state in memory.
#pragma once

#include "core/kernel/integrator/medium.h"
#include "core/kernel/shading/bsdf.h"

namespace pl {

/// A vertex from which a path is scattered.
template <FeatureSet F, class M>
struct ScatterPoint {
    SurfacePoint surface;
    Bsdf<F> bsdf;
    [[no_unique_address]] typename M::Vertex vertex{};
    float roulette_weight = 1.0f;  ///< 1 / survival probability of the roulette played here
};

/// Results of a step besides the path's state.
template <class M>
struct StepOutput {
    typename M::Sample& sample;  ///< comes in cleared
    PathCounters& counters;
};

/// The choice of lights that was learned for a vertex.
template <FeatureSet F, Method M>
PL_HD inline LearnedLights learned_lights([[maybe_unused]] const M& method,
                                          [[maybe_unused]] const typename M::Vertex& vertex) {
    if constexpr (learns_lights<F, M>)
        return method.learned_lights(vertex);
    else
        return {};
}

/// Density, per steradian, of scattering into wi by the lobes other than delta lobes, times their share of samples.
template <FeatureSet F, Method M>
PL_HD inline float scatter_pdf_sa(const M& method, const ScatterPoint<F, M>& from, Vec3f wi) {
    if constexpr (F.has_any(kLobeFeatures)) {
        if (!from.bsdf.is_lambert())
            return (1.0f - from.bsdf.delta_probability()) * method.pdf_sa(from.vertex, from.surface, from.bsdf, wi);
    }
    return method.pdf_sa(from.vertex, from.surface, wi);
}

/// An observation for the last vertex with a location, through the specular chain if there is one.
template <FeatureSet F, class M>
PL_HD inline Observation through_chain(const PathState<F, M>& state, Observation observation) {
    if constexpr (F.has_any(kLobeFeatures)) {
        if (state.chain.is_open)
            return {.emitted = state.chain.emitted + state.chain.weight * observation.emitted,
                    .albedo = state.chain.weight * observation.albedo,
                    .direction_share = 1.0f,  // light samples do not pass through delta lobes
                    .distance = state.chain.distance + observation.distance};
    }
    if constexpr (kTracksMedium<F>) {
        // Without a chain its weight is the transmittance of the glass around the segment.
        observation.emitted *= state.chain.weight;
        observation.albedo *= state.chain.weight;
    }
    return observation;
}

/// Ends a path at a vertex that reflects. An open specular chain is then the last observation of the last vertex with
/// a location.
template <FeatureSet F, Method M>
PL_HD inline PathStatus terminate_path(const M& method, PathState<F, M>& state, const StepOutput<M>& out) {
    if constexpr (F.has_any(kLobeFeatures)) {
        if (state.chain.is_open)
            out.sample =
                method.observe(state.memory, {.emitted = state.chain.emitted, .distance = state.chain.distance},
                               typename M::Vertex{}, out.counters.method);
    }
    method.terminated(state.memory, out.counters.method);
    return PathStatus::Finished;
}

/// Ends a path that sampled a direction with f cos = 0: a zero-valued sample.
template <FeatureSet F, Method M>
PL_HD inline PathStatus terminate_black(const M& method, PathState<F, M>& state, const StepOutput<M>& out) {
    ++out.counters.zero_directions;
    return terminate_path(method, state, out);
}

/// The path leaves a vertex that may have a location. event.weight and event.albedo belong to this vertex alone.
template <FeatureSet F, Method M>
PL_HD_INLINED void leave_vertex(const M& method, const typename M::Vertex& vertex, const ScatterEvent& event,
                                PathState<F, M>& state, PathCounters& counters) {
    Vec3f chain_weight{1.0f};
    if constexpr (F.has_any(kLobeFeatures)) {
        chain_weight = state.chain.weight;
        state.chain = {};
    }
    method.scattered(state.memory, vertex,
                     {chain_weight * event.weight, chain_weight * event.albedo, event.direction}, counters.method);
}

/// Sends the path into `direction` with weight f cos / pdf. direction.pdf_sa is the density by scatter_pdf_sa(), 0
/// for a delta lobe.
template <FeatureSet F, Method M>
PL_HD_INLINED PathStatus send_path(const M& method, const ScatterPoint<F, M>& from, const DirectionSample& direction,
                                   Vec3f weight, PathState<F, M>& state, PathCounters& counters) {
    state.throughput *= weight;
    state.ray = spawn_ray(from.surface, direction.wi);
    if constexpr (kTracksMedium<F>)
        state.medium = medium_towards(from.surface, from.bsdf, direction.wi, state.medium);
    if constexpr (F.has_any(kLobeFeatures)) {
        if (from.bsdf.is_specular()) {
            state.chain.weight *= weight;
            return PathStatus::Continues;
        }
    }
    leave_vertex(method, from.vertex, {from.roulette_weight * weight, from.bsdf.albedo(), direction}, state,
                 counters);
    return PathStatus::Continues;
}

/// Scatters a path at a Lambert reflector into a direction that the method sampled.
template <FeatureSet F, Method M>
PL_HD_INLINED PathStatus scatter_lambert(const M& method, const ScatterPoint<F, M>& from,
                                         const DirectionSample& direction, PathState<F, M>& state,
                                         const StepOutput<M>& out) {
    const float cos_i = from.bsdf.cosine(from.surface, direction.wi);
    if (!(direction.pdf_sa > 0.0f) || cos_i == 0.0f) return terminate_black(method, state, out);
    const Vec3f weight = from.bsdf.eval(from.surface, direction.wi, cos_i) * (1.0f / direction.pdf_sa);
    state.direction_pdf_sa = direction.pdf_sa;
    state.lights = learned_lights<F>(method, from.vertex);
    return send_path(method, from, direction, weight, state, out.counters);
}

/// Scatters a path at any other surface: first chooses between the delta lobes and the others. `numbers.lobe` is drawn here.
template <FeatureSet F, Method M>
PL_HD_INLINED PathStatus scatter_layered(const M& method, const ScatterPoint<F, M>& from, ScatterUniforms uniforms,
                                         PathState<F, M>& state, const StepOutput<M>& out) {
    const Vec4f choice = uniforms.rng.draw(uniforms.index, Purpose::Lobe);
    const float p = from.bsdf.delta_probability();
    if (choice.x < p) {
        const DeltaDirection delta = from.bsdf.sample_delta(from.surface, choice.y);
        if (is_black(delta.weight)) return terminate_black(method, state, out);
        state.direction_pdf_sa = 0.0f;
        return send_path(method, from, {.wi = delta.wi}, delta.weight * (1.0f / p), state, out.counters);
    }
    uniforms.lobe = choice.z;
    const DirectionSample direction = method.sample_direction(from.vertex, from.surface, from.bsdf, uniforms);
    const float pdf_sa = (1.0f - p) * direction.pdf_sa;
    const float cos_i = from.bsdf.cosine(from.surface, direction.wi);
    if (!(pdf_sa > 0.0f) || cos_i == 0.0f) return terminate_black(method, state, out);
    const Vec3f weight = from.bsdf.eval(from.surface, direction.wi, cos_i) * (1.0f / pdf_sa);
    if (is_black(weight)) return terminate_black(method, state, out);
    state.direction_pdf_sa = pdf_sa;
    state.lights = learned_lights<F>(method, from.vertex);
    return send_path(method, from, direction, weight, state, out.counters);
}

/// Samples the next direction of one path and scatters it.
template <FeatureSet F, Method M>
PL_HD_INLINED PathStatus scatter(const M& method, const ScatterPoint<F, M>& from, const ScatterUniforms& uniforms,
                                 PathState<F, M>& state, const StepOutput<M>& out) {
    if constexpr (F.has_any(kLobeFeatures)) {
        if (!from.bsdf.is_lambert()) return scatter_layered(method, from, uniforms, state, out);
    }
    return scatter_lambert(method, from, method.sample_direction(from.vertex, from.surface, uniforms), state, out);
}

}  // namespace pl
