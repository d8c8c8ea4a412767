// The integrator as steps on one path: begin, extend (once per hit), connect (once per shadow ray). Pure functions
// of their arguments, so that a loop over one path, a batch of paths and a GPU thread all call the same code. A driver
// that handles several paths at once calls the parts of extend_path: arrive, the method's choice of a direction, leave.
#pragma once

#include "core/kernel/integrator/departure.h"
#include "core/kernel/integrator/environment.h"
#include "core/kernel/scene/camera.h"
#include "core/kernel/shading/lights.h"

namespace pl {

/// Roulette never ends more than 9 of 10 paths at once, which bounds its weight.
inline constexpr float kMinSurvival = 0.1f;

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
    VertexNumbers numbers{.scatter = rng.draw(state.vertices + 1, Purpose::Scatter)};
    if constexpr (F.has(Feature::NextEventEstimation)) {
        if (settings.next_event != 0) numbers.light = rng.draw(state.vertices + 1, Purpose::Light);
    }
    return numbers;
}

/// Starts a path at the camera, somewhere in a pixel; `u` is drawn for vertex 0 and Purpose::Pixel.
template <FeatureSet F, class M>
PL_HD inline PathState<F, M> begin_path(const Camera& camera, std::uint32_t width, std::uint32_t height,
                                        std::uint32_t pixel, std::uint32_t sample, Vec4f u) {
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
    const Vec4f u = path_rng(settings, pixel, sample).draw(0, Purpose::Pixel);
    return begin_path<F, M>(camera, width, height, pixel, sample, u);
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

/// Chance of going on. An opinion may be wrong, and most are at first, so by RouletteRule::Spare it can spare a path but not
/// end it sooner than the reflectances alone would: weights then grow no faster than they fall by reflection, and their
/// variance stays finite. RouletteRule::Field trusts the opinion.
PL_HD inline float survival_probability(const PathSettings& settings, float worth, float survival) {
    float wanted = survival;
    if (settings.roulette == RouletteRule::Spare) wanted = max_of(worth / settings.roulette_threshold, survival);
    if (settings.roulette == RouletteRule::Field) wanted = worth / settings.roulette_threshold;
    return clamp_to(wanted, kMinSurvival, 1.0f);
}

/// Plays Russian roulette with the method's opinion of what the path is still worth. Returns 0 if the path ends, else the
/// weight of those that go on.
template <FeatureSet F, Method M>
PL_HD inline float play_roulette(const M& method, const PathSettings& settings, const typename M::Vertex& vertex,
                                 Vec3f albedo, float u, PathState<F, M>& state) {
    state.survival *= max_component(albedo);
    const float worth = method.roulette_worth(vertex, albedo, state.throughput, state.survival, state.expectation);
    if (state.vertices < settings.roulette_start) return 1.0f;
    const float probability = survival_probability(settings, worth, state.survival);
    if (u >= probability) return 0.0f;
    state.throughput *= 1.0f / probability;
    state.survival = min_of(state.survival / probability, 1.0f);
    return 1.0f / probability;
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
/// whether the path goes on. `shadow` and `record` come in cleared; `departure` is only good if the path continues.
template <FeatureSet F, Method M>
PL_HD inline PathStatus arrive(const SceneView& scene, const M& method, const PathSettings& settings, const Hit& hit,
                               const VertexNumbers& numbers, PathState<F, M>& state, Departure<F, M>& departure,
                               typename M::Record& record, ShadowRequest& shadow, PathCounters& counters) {
    ++counters.segments;
    if (!hit.found()) {
        ++counters.escaped;
        const FarArrival far = add_environment(scene, settings, state);
        record = method.learn(state.memory,
                              seen_from_last_vertex(state, {.emitted = far.radiance, .light_share = far.share}),
                              typename M::Vertex{}, counters.method);
        return PathStatus::Finished;
    }
    const SurfacePoint surface = make_surface_point<F>(scene, hit, -state.ray.direction);
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
    const float roulette_weight = play_roulette(method, settings, vertex, albedo, numbers.scatter.w, state);
    if (roulette_weight == 0.0f) return cut_path(method, state, record, counters);
    if constexpr (FollowingMethod<M>) state.memory.roulette_weight = roulette_weight;
    if constexpr (F.has_any(kLobeFeatures)) {
        if (bsdf.passes_on()) state.passage.weight *= roulette_weight;
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
    PathStatus status = arrive<F>(scene, method, settings, hit, numbers, state, departure, record, shadow, counters);
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

/// The path is over, and so is its last shadow ray: what can be learned only from whole paths is learned.
template <FeatureSet F, Method M>
PL_HD inline void end_path(const M& method, PathState<F, M>& state, PathCounters& counters) {
    if constexpr (FollowingMethod<M>) method.finish(state.memory, counters.method);
}

}  // namespace pl
