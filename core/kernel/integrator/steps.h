// The integrator as steps on one path: begin, extend (once per hit), connect (once per shadow ray). Pure functions
// of their arguments, so that a loop over one path, a batch of paths and a GPU thread all call the same code. A driver
// that handles several paths at once calls the parts of extend_path: arrive, the method's choice of a direction, leave.
#pragma once

#include "core/kernel/film/pixel_sequence.h"
#include "core/kernel/integrator/departure.h"
#include "core/kernel/integrator/environment.h"
#include "core/kernel/integrator/roulette.h"
#include "core/kernel/scene/camera.h"
#include "core/kernel/shading/lights.h"

namespace pl {

PL_HD inline Rng path_rng(const PathSettings& settings, std::uint32_t pixel, std::uint32_t sample) {
    return {settings.seed, settings.stream, pixel, sample};
}

/// The uniform numbers that a path uses up where its segment ends. An argument of the step, so that a back end may
/// draw those of many paths at once.
struct VertexNumbers {
    Vec4f scatter{0.0f};
    Vec4f light{0.0f};  ///< drawn only where lights are sampled
};

template <FeatureSet F, class M>
PL_HD inline VertexNumbers draw_vertex_numbers(const PathSettings& settings, const PathState<F, M>& state) {
    const Rng rng = path_rng(settings, state.pixel, state.sample);
    VertexNumbers numbers{.scatter = rng.draw(state.draw_index() + 1, Purpose::Scatter)};
    if constexpr (F.has(Feature::NextEventEstimation)) {
        if (settings.next_event != 0) numbers.light = rng.draw(state.draw_index() + 1, Purpose::Light);
    }
    return numbers;
}

/// Starts a path at the camera, somewhere in a pixel; `start` is that of the pixel's sequence, see pixel_sample().
template <FeatureSet F, class M>
PL_HD inline PathState<F, M> begin_path(const Camera& camera, std::uint32_t width, std::uint32_t height,
                                        std::uint32_t pixel, std::uint32_t sample, Vec4f start) {
    const Vec4f u = pixel_sample(start, sample);
    const Vec2f film{static_cast<float>(pixel % width) + u.x, static_cast<float>(pixel / width) + u.y};
    PathState<F, M> state;
    state.ray = generate_ray(camera, film, {static_cast<float>(width), static_cast<float>(height)});
    if constexpr (F.has(Feature::ThinLens)) {
        if (camera.aperture_radius > 0.0f) state.ray = through_lens(camera, state.ray, {u.z, u.w});
    }
    state.pixel = pixel;
    state.sample = sample;
    return state;
}

template <FeatureSet F, class M>
PL_HD inline PathState<F, M> begin_path(const Camera& camera, const PathSettings& settings, std::uint32_t width,
                                        std::uint32_t height, std::uint32_t pixel, std::uint32_t sample) {
    const Vec4f start = path_rng(settings, pixel, sequence_of(sample)).draw(0, Purpose::Pixel);
    return begin_path<F, M>(camera, width, height, pixel, sample, start);
}

/// Emission of the surface just met, as the path sees it. Where the previous vertex sampled lights too, the two
/// strategies share it. Returns the share that the path brings.
template <FeatureSet F, class M>
PL_HD inline float add_emission(const SceneView& scene, const PathSettings& settings, const SurfacePoint& surface,
                                Vec3f emitted, PathState<F, M>& state) {
    const float weight = direction_weight(
        settings, state, [&] { return light_pdf_sa<F>(scene, state.ray.origin, surface, state.ray.direction); });
    state.radiance += weight * (state.throughput * emitted);
    return weight;
}

/// Light sample at a vertex; `shadow.wanted` stays false if it cannot contribute.
template <FeatureSet F, Method M>
PL_HD inline void request_shadow_ray(const SceneView& scene, const M& method, const Departure<F, M>& from, Vec4f u,
                                     PathState<F, M>& state, ShadowRequest& shadow) {
    const DirectLight sample = sample_direct_light<F>(scene, from.surface, from.bsdf, {u.x, u.y, u.z}, u.w);
    if (!(sample.pdf_sa > 0.0f)) return;
    const float weight = balance_weight(sample.pdf_sa, departure_pdf_sa(method, from, sample.wi));
    const Vec3f reflectance = from.bsdf.eval(from.surface, sample.wi, sample.cos_i);
    shadow.ray = shadow_ray_to<F>(from.surface, sample);
    shadow.contribution = state.throughput * reflectance * sample.emitted * (weight / sample.pdf_sa);
    shadow.wanted = true;
    if constexpr (FollowingMethod<M>) {
        Vec3f learned = reflectance * sample.emitted * (weight / sample.pdf_sa);
        if constexpr (F.has_any(kLobeFeatures)) {
            // What passes light on has brought it by its directions alone.
            learned = from.bsdf.passes_on() ? Vec3f{0.0f} : state.passage.weight * learned;
        }
        method.request_light(state.memory, learned);
    }
}

/// What the path learns where its segment ends; returns what the method knows about the place.
template <FeatureSet F, Method M>
PL_HD inline typename M::Vertex learn_at(const M& method, const SurfacePoint& surface, const Bsdf<F>& bsdf,
                                         const Arrival& arrival, PathState<F, M>& state, typename M::Record& record,
                                         PathCounters& counters) {
    typename M::Vertex vertex{};
    if constexpr (F.has_any(kLobeFeatures)) {
        if (bsdf.passes_on()) {
            state.passage.emitted += state.passage.weight * arrival.emitted;
            state.passage.distance += arrival.distance;
            state.passage.is_open = true;
            return vertex;
        }
    }
    if (bsdf.scatters()) vertex = method.arrive(surface, counters.method);
    record = method.learn(state.memory, seen_from_last_vertex(state, arrival), vertex, counters.method);
    if constexpr (F.has_any(kLobeFeatures))
        state.passage.is_open = false;  // the weight is needed until the path leaves
    return vertex;
}

/// Consumes the hit of the path's segment: collects emission, lets the method learn, asks for a shadow ray and decides
/// whether the path goes on. surface_of() is asked for the surface once if there is one. `shadow` and `record` come in
/// cleared; `departure` is only good if the path continues.
template <FeatureSet F, Method M, class SurfaceOf>
PL_HD inline PathStatus arrive(const SceneView& scene, const M& method, const PathSettings& settings, const Hit& hit,
                               const SurfaceOf& surface_of, const VertexNumbers& numbers, PathState<F, M>& state,
                               Departure<F, M>& departure, typename M::Record& record, ShadowRequest& shadow,
                               PathCounters& counters) {
    ++counters.segments;
    if (!hit.found()) {
        ++counters.escaped;
        const FarArrival far = add_environment(scene, settings, state);
        record = method.learn(state.memory,
                              seen_from_last_vertex(state, {.emitted = far.radiance, .light_share = far.share}),
                              typename M::Vertex{}, counters.method);
        return PathStatus::Finished;
    }
    const SurfacePoint& surface = surface_of();
    const Bsdf<F> bsdf = make_bsdf<F>(scene, surface, hit_weights(hit), -state.ray.direction);
    const Vec3f albedo = bsdf.albedo();
    const Vec3f emitted = emitted_at<F>(scene, surface, hit_weights(hit));
    float light_share = 1.0f;
    if (!is_black(emitted)) light_share = add_emission(scene, settings, surface, emitted, state);

    const Arrival arrival{.emitted = emitted, .albedo = albedo, .light_share = light_share, .distance = hit.t};
    const typename M::Vertex vertex = learn_at<F>(method, surface, bsdf, arrival, state, record, counters);
    ++state.vertices;
    if (!bsdf.scatters()) return PathStatus::Finished;
    if (state.vertices >= settings.max_depth) {
        ++counters.truncated;
        return cut_path(method, state, record, counters);
    }
    if constexpr (F.has(Feature::NextEventEstimation)) {
        if (settings.next_event != 0)
            request_shadow_ray<F, M>(scene, method, {surface, bsdf, vertex}, numbers.light, state, shadow);
    }
    const Continuation next = play_roulette(method, settings, vertex, albedo, numbers.scatter.w, state);
    if (next.branches == 0) return cut_path(method, state, record, counters);
    if constexpr (FollowingMethod<M>) state.memory.roulette_weight = next.weight;
    if constexpr (F.has_any(kLobeFeatures)) {
        if (bsdf.passes_on()) state.passage.weight *= next.weight;
    }
    if constexpr (SplittingMethod<M>) {
        if (next.branches > 1)
            state.branches.wait({-state.ray.direction, hit, state.throughput, state.survival, state.vertices,
                                 next.branches - 1, vertex});
    }
    departure = {surface, bsdf, vertex};
    return PathStatus::Continues;
}

/// All that happens where a segment ends: the path's ray is then the next segment. `shadow` comes in cleared.
template <FeatureSet F, Method M>
PL_HD inline PathStatus extend_path(const SceneView& scene, const M& method, const PathSettings& settings,
                                    const Hit& hit, const VertexNumbers& numbers, PathState<F, M>& state,
                                    ShadowRequest& shadow, PathCounters& counters) {
    Departure<F, M> departure;
    typename M::Record record{};
    const auto surface_of = [&] { return make_surface_point<F>(scene, hit, -state.ray.direction); };
    PathStatus status =
        arrive<F>(scene, method, settings, hit, surface_of, numbers, state, departure, record, shadow, counters);
    if (status == PathStatus::Continues) {
        const Rng rng = path_rng(settings, state.pixel, state.sample);
        status = choose_and_leave(method, departure, rng, numbers.scatter, state, record, counters);
    }
    method.commit(record);
    return status;
}

/// Adds a light sample whose shadow ray found nothing in between.
template <FeatureSet F, Method M>
PL_HD inline void connect_light(const M& method, const ShadowRequest& shadow, PathState<F, M>& state,
                                PathCounters& counters) {
    state.radiance += shadow.contribution;
    if constexpr (FollowingMethod<M>) method.receive_light(state.memory, counters.method);
}

/// Sends a branch that waits on its way. It knows nothing of those before it, and no light is sampled for it again.
template <FeatureSet F, SplittingMethod M>
PL_HD inline PathStatus begin_branch(const SceneView& scene, const M& method, const PathSettings& settings,
                                     PathState<F, M>& state, PathCounters& counters) {
    const Fork<typename M::Vertex> fork = state.branches.begin();
    state.throughput = fork.throughput;
    state.survival = fork.survival;
    state.vertices = fork.vertices;
    state.memory = {};
    state.passage = {};
    const SurfacePoint surface = make_surface_point<F>(scene, fork.hit, fork.wo);
    const Bsdf<F> bsdf = make_bsdf<F>(scene, surface, hit_weights(fork.hit), fork.wo);
    const Rng rng = path_rng(settings, state.pixel, state.sample);
    typename M::Record none{};
    return choose_and_leave<F, M>(method, {surface, bsdf, fork.vertex}, rng,
                                  rng.draw(state.draw_index(), Purpose::Scatter), state, none, counters);
}

/// The path, or a branch of it, is over, and so is its last shadow ray: what can be learned only from whole paths is
/// learned, and the next branch sets out. Returns whether there is one.
template <FeatureSet F, Method M>
PL_HD inline PathStatus end_branch(const SceneView& scene, const M& method, const PathSettings& settings,
                                   PathState<F, M>& state, PathCounters& counters) {
    if constexpr (FollowingMethod<M>) method.finish(state.memory, counters.method);
    if constexpr (SplittingMethod<M>) {
        while (state.branches.waiting > 0)
            if (begin_branch(scene, method, settings, state, counters) == PathStatus::Continues)
                return PathStatus::Continues;
    }
    return PathStatus::Finished;
}

}  // namespace pl
