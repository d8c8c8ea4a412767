// How a path leaves a vertex: by a lobe of a single direction, or by one that the method chooses from; and how it ends there.
#pragma once

#include "core/kernel/integrator/path.h"
#include "core/kernel/shading/bsdf.h"

namespace pl {

/// Where a path stands before its next direction is chosen.
template <FeatureSet F, class M>
struct Departure {
    SurfacePoint surface;
    Bsdf<F> bsdf;
    [[no_unique_address]] typename M::Vertex vertex{};
};

/// Density, per steradian, of all by which a path may leave a vertex towards wi.
template <FeatureSet F, Method M>
PL_HD inline float departure_pdf_sa(const M& method, const Departure<F, M>& from, Vec3f wi) {
    if constexpr (F.has_any(kLobeFeatures)) {
        if (!from.bsdf.is_lambert())
            return (1.0f - from.bsdf.delta_probability()) * method.pdf_sa(from.vertex, from.surface, from.bsdf, wi);
    }
    return method.pdf_sa(from.vertex, from.surface, wi);
}

/// What arrives at the last vertex that learns: through the surfaces that passed it on, if there were any.
template <FeatureSet F, class M>
PL_HD inline Arrival seen_from_last_vertex(const PathState<F, M>& state, Arrival arrival) {
    if constexpr (F.has_any(kLobeFeatures)) {
        if (state.passage.is_open)
            return {.emitted = state.passage.emitted + state.passage.weight * arrival.emitted,
                    .albedo = state.passage.weight * arrival.albedo,
                    .light_share = 1.0f,  // light samples do not see through them
                    .distance = state.passage.distance + arrival.distance};
    }
    return arrival;
}

/// A path ends at a vertex although light may come from behind it. Where that vertex only passes light on, the one before
/// has now seen all that it will.
template <FeatureSet F, Method M>
PL_HD inline PathStatus cut_path(const M& method, PathState<F, M>& state, typename M::Record& record,
                                 PathCounters& counters) {
    if constexpr (F.has_any(kLobeFeatures)) {
        if (state.passage.is_open)
            record =
                method.learn(state.memory, {.emitted = state.passage.emitted, .distance = state.passage.distance},
                             typename M::Vertex{}, counters.method);
    }
    if constexpr (FollowingMethod<M>) method.stop(state.memory, counters.method);
    return PathStatus::Finished;
}

/// Sends the path on. `weight` is f cos / pdf, `pdf_sa` the density of the direction, 0 for a delta lobe.
template <FeatureSet F, Method M>
PL_HD inline PathStatus go_on(const M& method, const Departure<F, M>& departure, const DirectionSample& direction,
                              Vec3f weight, float pdf_sa, PathState<F, M>& state, PathCounters& counters) {
    state.throughput *= weight;
    state.ray = spawn_ray(departure.surface, direction.wi);
    state.direction_pdf_sa = pdf_sa;
    Vec3f passed{1.0f};
    if constexpr (F.has_any(kLobeFeatures)) {
        if (departure.bsdf.passes_on()) {
            state.passage.weight *= weight;
            return PathStatus::Continues;
        }
        passed = state.passage.weight;
        state.passage = {};
    }
    if constexpr (FollowingMethod<M>) {
        method.depart(state.memory, departure.vertex,
                      {passed * (state.memory.roulette_weight * weight), passed * departure.bsdf.albedo(), direction},
                      counters.method);
    } else {
        state.memory = method.remember(departure.vertex, direction);
    }
    return PathStatus::Continues;
}

/// The path has drawn a direction that the surface does not reflect: a sample of value 0.
template <FeatureSet F, Method M>
PL_HD inline PathStatus end_in_the_dark(const M& method, PathState<F, M>& state, typename M::Record& record,
                                        PathCounters& counters) {
    ++counters.zero_directions;
    return cut_path(method, state, record, counters);
}

/// Moves the path's ray into the direction chosen at a Lambert reflector.
template <FeatureSet F, Method M>
PL_HD inline PathStatus leave(const M& method, const Departure<F, M>& departure, const DirectionSample& direction,
                              PathState<F, M>& state, typename M::Record& record, PathCounters& counters) {
    const float cos_i = departure.bsdf.cosine(departure.surface, direction.wi);
    if (!(direction.pdf_sa > 0.0f) || cos_i == 0.0f) return end_in_the_dark(method, state, record, counters);
    const Vec3f weight = departure.bsdf.eval(departure.surface, direction.wi, cos_i) * (1.0f / direction.pdf_sa);
    return go_on(method, departure, direction, weight, direction.pdf_sa, state, counters);
}

/// The same at any other surface: first chooses between its lobes of a single direction and the others.
template <FeatureSet F, Method M>
PL_HD inline PathStatus leave_by_lobe(const M& method, const Departure<F, M>& departure, const Rng& rng, Vec4f u,
                                      PathState<F, M>& state, typename M::Record& record, PathCounters& counters) {
    const Vec4f choice = rng.draw(state.draw_index(), Purpose::Lobe);
    const float p = departure.bsdf.delta_probability();
    if (choice.x < p) {
        const DeltaDirection delta = departure.bsdf.sample_delta(departure.surface, choice.y);
        if (is_black(delta.weight)) return end_in_the_dark(method, state, record, counters);
        return go_on(method, departure, {.wi = delta.wi}, delta.weight * (1.0f / p), 0.0f, state, counters);
    }
    const DirectionSample direction = method.sample_direction(departure.vertex, departure.surface, departure.bsdf,
                                                              rng, state.draw_index(), u, choice.z);
    const float pdf_sa = (1.0f - p) * direction.pdf_sa;
    const float cos_i = departure.bsdf.cosine(departure.surface, direction.wi);
    if (!(pdf_sa > 0.0f) || cos_i == 0.0f) return end_in_the_dark(method, state, record, counters);
    const Vec3f weight = departure.bsdf.eval(departure.surface, direction.wi, cos_i) * (1.0f / pdf_sa);
    if (is_black(weight)) return end_in_the_dark(method, state, record, counters);
    return go_on(method, departure, direction, weight, pdf_sa, state, counters);
}

/// Chooses the next direction of one path and takes it.
template <FeatureSet F, Method M>
PL_HD inline PathStatus choose_and_leave(const M& method, const Departure<F, M>& departure, const Rng& rng, Vec4f u,
                                         PathState<F, M>& state, typename M::Record& record, PathCounters& counters) {
    if constexpr (F.has_any(kLobeFeatures)) {
        if (!departure.bsdf.is_lambert()) return leave_by_lobe(method, departure, rng, u, state, record, counters);
    }
    const DirectionSample direction =
        method.sample_direction(departure.vertex, departure.surface, rng, state.draw_index(), u);
    return leave(method, departure, direction, state, record, counters);
}

}  // namespace pl
