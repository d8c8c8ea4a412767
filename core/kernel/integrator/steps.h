// The integrator as steps on one path: begin, shade (once per hit), sample a light (light_sample.h), continue (roulette), scatter
// (scatter.h), connect (once per shadow ray). Pure functions of their arguments, so that a loop over one path (trace_path.h), a batch
// of paths (cpu/paths/path_batch.h) and a GPU thread (cuda/kernels/trace.cuh) call the same code. Drivers of several paths call the steps
// apart, so that they can sample directions, and evaluate densities of directions and of lights, for many paths at once.
#pragma once

#include "core/kernel/integrator/environment.h"
#include "core/kernel/integrator/light_sample.h"
#include "core/kernel/integrator/roulette.h"
#include "core/kernel/scene/camera.h"
#include "core/kernel/shading/lights.h"

namespace pl {

PL_HD inline Rng path_rng(const PathSettings& settings, std::uint32_t pixel, std::uint32_t sample) {
    return {settings.seed, settings.stream, pixel, sample};
}

/// Uniform numbers of a vertex: an argument of the steps, so that a back end may draw the numbers of many paths at
/// once.
struct VertexUniforms {
    Vec4f scatter{0.0f};  ///< ScatterUniforms::u
    Vec4f light{0.0f};    ///< drawn only if lights are sampled
};

/// The numbers of the vertex at the end of the path's segment.
template <FeatureSet F, class M>
PL_HD inline VertexUniforms draw_vertex_uniforms(const PathSettings& settings, const PathState<F, M>& state) {
    const Rng rng = path_rng(settings, state.pixel, state.sample);
    VertexUniforms uniforms{.scatter =
                                vertex_uniforms(rng, settings.sequences, state.vertices + 1, Purpose::Scatter)};
    if constexpr (F.has(Feature::NextEventEstimation)) {
        if (settings.next_event != 0)
            uniforms.light = vertex_uniforms(rng, settings.sequences, state.vertices + 1, Purpose::Light);
    }
    return uniforms;
}

/// The numbers by which a path is scattered at its current vertex.
template <FeatureSet F, class M>
PL_HD inline ScatterUniforms scatter_uniforms(const PathSettings& settings, const PathState<F, M>& state, Vec4f u) {
    return {.rng = path_rng(settings, state.pixel, state.sample), .index = state.vertices, .u = u};
}

/// The first number of a pixel's sequence.
PL_HD inline Vec4f pixel_start(const PathSettings& settings, std::uint32_t pixel, std::uint32_t sample) {
    return path_rng(settings, pixel, sequence_of(sample)).draw(0, Purpose::Pixel);
}

/// The raster that paths start from, and the number of their sample.
struct PixelGrid {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint32_t sample = 0;
};

/// A camera ray through the point u.x, u.y of a pixel and u.z, u.w of the lens, all in [0,1).
template <FeatureSet F>
PL_HD inline Ray camera_ray(const Camera& camera, const PixelGrid& grid, std::uint32_t pixel, Vec4f u) {
    const Vec2f film{static_cast<float>(pixel % grid.width) + u.x, static_cast<float>(pixel / grid.width) + u.y};
    const Ray ray = generate_ray(camera, film, {static_cast<float>(grid.width), static_cast<float>(grid.height)});
    if constexpr (F.has(Feature::ThinLens)) {
        if (camera.aperture_radius > 0.0f) return through_lens(camera, ray, {u.z, u.w});
    }
    return ray;
}

/// Starts a path along a camera ray.
template <FeatureSet F, class M>
PL_HD inline PathState<F, M> begin_path(const Ray& ray, const PixelGrid& grid, std::uint32_t pixel) {
    PathState<F, M> state;
    state.ray = ray;
    state.pixel = pixel;
    state.sample = grid.sample;
    return state;
}
/// Starts a path at the camera; `start` is the first number of the pixel's sequence, see pixel_sample().
template <FeatureSet F, class M>
PL_HD inline PathState<F, M> begin_path(const Camera& camera, const PixelGrid& grid, std::uint32_t pixel,
                                        Vec4f start) {
    return begin_path<F, M>(camera_ray<F>(camera, grid, pixel, pixel_sample(start, grid.sample)), grid, pixel);
}

template <FeatureSet F, class M>
PL_HD inline PathState<F, M> begin_path(const Camera& camera, const PathSettings& settings, const PixelGrid& grid,
                                        std::uint32_t pixel) {
    return begin_path<F, M>(camera, grid, pixel, pixel_start(settings, pixel, grid.sample));
}

/// The surface at the end of a path's segment, as shade_hit() asks for it. A driver of several paths has a class of its own, which may
/// know the results for many paths at once. Lambdas instead would not be inlined into the largest kernels of a device.
template <FeatureSet F, class M>
struct SurfaceAhead {
    const SceneView& scene;
    const Hit& hit;
    const PathState<F, M>& state;

    /// Sets the surface point in its place: the wide loads of a copy would wait for the narrow stores before them.
    PL_HD_INLINED void find(SurfacePoint& surface) const {
        surface = make_surface_point<F>(scene, hit, -state.ray.direction);
    }
    /// See pl::light_pdf_area(), for the origin of the segment. The surface emits light.
    PL_HD float light_pdf_area(const SurfacePoint& surface) const {
        return pl::light_pdf_area<F>(scene, state.ray.origin, surface, learned_lights(state));
    }
};

/// Adds the emission of the surface hit to the path's estimator, weighted where the last vertex sampled lights. Returns the
/// weight. `ahead`: see shade_hit().
template <FeatureSet F, class M, class Ahead>
PL_HD inline float add_emission(const PathContext<M>& context, const Ahead& ahead, const SurfacePoint& surface,
                                Vec3f emitted, PathState<F, M>& state) {
    const float weight = direction_weight(context.settings, state, [&] {
        return on_light_pdf_sa(context.scene, ahead.light_pdf_area(surface), state.ray.origin, surface,
                               state.ray.direction);
    });
    state.radiance += weight * (state.throughput * emitted);
    return weight;
}

/// The path's specular chain goes through the surface hit.
template <FeatureSet F, class M>
PL_HD inline void extend_chain(const Observation& observation, PathState<F, M>& state) {
    state.chain.emitted += state.chain.weight * observation.emitted;
    state.chain.distance += observation.distance;
    state.chain.is_open = true;
}

/// Calls the method's observe() for the surface hit, which is not specular. `vertex`: the method's data there.
template <FeatureSet F, Method M>
PL_HD inline void observe_end(const M& method, const typename M::Vertex& vertex, const Observation& observation,
                              PathState<F, M>& state, const StepOutput<M>& out) {
    out.sample = method.observe(state.memory, through_chain(state, observation), vertex, out.counters.method);
    if constexpr (F.has_any(kLobeFeatures))
        state.chain.is_open = false;  // its weight is needed until the path is scattered
}

/// Calls the method's observe() for the surface hit. Returns the method's data of the vertex.
template <FeatureSet F, Method M>
PL_HD inline typename M::Vertex observe_vertex(const M& method, const SurfacePoint& surface, const Bsdf<F>& bsdf,
                                               const Observation& observation, PathState<F, M>& state,
                                               const StepOutput<M>& out) {
    typename M::Vertex vertex{};
    if constexpr (F.has_any(kLobeFeatures)) {
        if (bsdf.is_specular()) {
            extend_chain(observation, state);
            return vertex;
        }
    }
    if (bsdf.scatters()) vertex = method.locate(surface, out.counters.method);
    observe_end<F>(method, vertex, observation, state, out);
    return vertex;
}

/// The path's segment missed all surfaces.
template <FeatureSet F, Method M>
PL_HD inline PathStatus shade_miss(const PathContext<M>& context, PathState<F, M>& state, const StepOutput<M>& out) {
    ++out.counters.escaped;
    const Observation observation = add_environment(context.scene, context.settings, state);
    out.sample = context.method.observe(state.memory, through_chain(state, observation), typename M::Vertex{},
                                        out.counters.method);
    return PathStatus::Finished;
}

/// Russian roulette at the vertex `from`, by the uniform number `u`. Returns whether the path continues.
template <FeatureSet F, Method M>
PL_HD_INLINED PathStatus continue_path(const PathContext<M>& context, float u, PathState<F, M>& state,
                                       ScatterPoint<F, M>& from, const StepOutput<M>& out) {
    from.roulette_weight = play_roulette(context.method, context.settings, from.vertex, from.bsdf.albedo(), u, state);
    if (from.roulette_weight == 0.0f) return terminate_path(context.method, state, out);
    if constexpr (F.has_any(kLobeFeatures)) {
        if (from.bsdf.is_specular()) state.chain.weight *= from.roulette_weight;
    }
    return PathStatus::Continues;
}

/// Shades the end of the path's segment: adds emission and calls the observe() of the method. Returns whether the path reaches a
/// vertex where it may go on; only then `from` is valid. `ahead` has the members of SurfaceAhead; find() is called once if there is a hit.
template <FeatureSet F, Method M, class Ahead>
PL_HD_INLINED PathStatus shade_hit(const PathContext<M>& context, const Hit& hit, const Ahead& ahead,
                                   PathState<F, M>& state, ScatterPoint<F, M>& from, const StepOutput<M>& out) {
    ++out.counters.segments;
    absorb_segment(context.scene, hit, state);
    if (!hit.found()) return shade_miss(context, state, out);
    const SceneView& scene = context.scene;
    ahead.find(from.surface);
    const SurfacePoint& surface = from.surface;
    const Bsdf<F> bsdf = make_bsdf<F>(scene, surface, hit_weights(hit), -state.ray.direction);
    const Vec3f emitted = emitted_at<F>(scene, surface, hit_weights(hit));
    float direction_share = 1.0f;
    if (!is_black(emitted)) direction_share = add_emission(context, ahead, surface, emitted, state);

    const Observation observation{
        .emitted = emitted, .albedo = bsdf.albedo(), .direction_share = direction_share, .distance = hit.t};
    const typename M::Vertex vertex = observe_vertex<F>(context.method, surface, bsdf, observation, state, out);
    ++state.vertices;
    if constexpr (F.has_any(kLobeFeatures)) {
        if (bsdf.is_specular()) count_specular(context.settings, state);
    }
    if (!bsdf.scatters()) return PathStatus::Finished;
    if (state.vertices >= context.settings.max_depth) {
        ++out.counters.truncated;
        return terminate_path(context.method, state, out);
    }
    from.bsdf = bsdf;
    from.vertex = vertex;
    return PathStatus::Continues;
}

/// Adds a light sample whose shadow ray is not occluded.
template <FeatureSet F, Method M>
PL_HD inline void connect_light(const M& method, const ShadowRequest<M>& shadow, PathState<F, M>& state,
                                PathCounters& counters) {
    state.radiance += shadow.contribution;
    method.light_received(state.memory, counters.method);
}

}  // namespace pl
