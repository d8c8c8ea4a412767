// The loop over one path: the integrator from beginning to end. A GPU thread runs it (cuda/kernels/trace.cuh), and so do tests
// and the search for diagnostics; on the CPU, pictures run the same steps over batches of paths (cpu/paths/path_batch.h).
#pragma once

#include "core/kernel/integrator/holes.h"
#include "core/kernel/integrator/steps.h"

namespace pl {

/// The vertex at the end of a path's segment, for the steps shade_segment(), sample_light_at_end() and scatter_at_end().
template <FeatureSet F, class M>
struct SegmentEnd {
    VertexUniforms uniforms;
    ScatterPoint<F, M> from;  ///< valid only while the path continues
    typename M::Sample sample{};
};

/// Shades the end of a path's segment. `end` comes in cleared.
template <FeatureSet F, Method M>
PL_HD_INLINED PathStatus shade_segment(const PathContext<M>& context, const Hit& hit, PathState<F, M>& state,
                                       SegmentEnd<F, M>& end, PathCounters& counters) {
    end.uniforms = draw_vertex_uniforms<F>(context.settings, state);
    return shade_hit<F, M>(context, hit, SurfaceAhead<F, M>{context.scene, hit, state}, state, end.from,
                           {end.sample, counters});
}

/// Samples a light at the end of a path's segment, if the path may continue there, and then plays the roulette. `shadow` comes in
/// cleared. `status`: of shade_segment().
template <FeatureSet F, Method M>
PL_HD_INLINED PathStatus sample_light_at_end(const PathContext<M>& context, PathStatus status, SegmentEnd<F, M>& end,
                                             PathState<F, M>& state, ShadowRequest<M>& shadow,
                                             PathCounters& counters) {
    if (status != PathStatus::Continues) return status;
    request_light(context, end.from, end.uniforms.light, state, shadow);
    return continue_path<F, M>(context, end.uniforms.scatter.w, state, end.from, {end.sample, counters});
}

/// Scatters a path at the end of its segment, if it continues there: its ray is then the next segment. `status`: of
/// sample_light_at_end().
template <FeatureSet F, Method M>
PL_HD_INLINED PathStatus scatter_at_end(const PathContext<M>& context, PathStatus status, SegmentEnd<F, M>& end,
                                        PathState<F, M>& state, PathCounters& counters) {
    if (status == PathStatus::Continues)
        status =
            scatter<F, M>(context.method, end.from, scatter_uniforms(context.settings, state, end.uniforms.scatter),
                          state, {end.sample, counters});
    context.method.record(end.sample);
    return status;
}

/// Traces the shadow ray of a light sample, if there is one, and tells the method of the path's end. `status`: of scatter_at_end().
template <FeatureSet F, Method M, Intersector I>
PL_HD_INLINED PathStatus connect_segment(const PathContext<M>& context, const I& intersector,
                                         const ShadowRequest<M>& shadow, PathStatus status, PathState<F, M>& state,
                                         PathCounters& counters) {
    if constexpr (F.has(Feature::NextEventEstimation)) {
        bool is_visible = false;
        if (shadow.wanted) {
            ++counters.shadow_rays;
            is_visible = !is_blocked<F>(context.scene, intersector, shadow.ray);
            if (is_visible) connect_light(context.method, shadow, state, counters);
        }
        context.method.record_light(shadow.light, is_visible);
    }
    if (status == PathStatus::Finished) context.method.finished(state.memory, counters.method);
    return status;
}

/// Traces one segment of a path, and the shadow ray at its end.
template <FeatureSet F, Method M, Intersector I>
PL_HD_INLINED PathStatus trace_segment(const PathContext<M>& context, const I& intersector, PathState<F, M>& state,
                                       PathCounters& counters) {
    const Hit hit = closest_solid_hit<F>(context.scene, intersector, state.ray);
    ShadowRequest<M> shadow;
    SegmentEnd<F, M> end;
    PathStatus status = shade_segment<F>(context, hit, state, end, counters);
    status = sample_light_at_end<F>(context, status, end, state, shadow, counters);
    status = scatter_at_end<F>(context, status, end, state, counters);
    return connect_segment<F>(context, intersector, shadow, status, state, counters);
}

/// `store`: the path's memory outside of its state.
template <FeatureSet F, Method M, Intersector I>
PL_HD inline void trace_path(const PathContext<M>& context, const I& intersector, PathState<F, M>& state,
                             typename M::Store& store, PathCounters& counters) {
    keep_store(state, &store);
    PathStatus status = PathStatus::Continues;
    while (status == PathStatus::Continues) status = trace_segment<F>(context, intersector, state, counters);
}
template <FeatureSet F, Method M, Intersector I>
PL_HD inline void trace_path(const PathContext<M>& context, const I& intersector, PathState<F, M>& state,
                             PathCounters& counters) {
    typename M::Store store;
    trace_path<F>(context, intersector, state, store, counters);
    drop_store(state);
}

}  // namespace pl
