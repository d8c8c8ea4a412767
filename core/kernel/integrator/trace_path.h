// The loop over one path: the integrator from beginning to end. A GPU thread runs it (cuda/kernels/trace.cuh), and so do tests
// and the search for diagnostics; on the CPU, pictures run the same steps over batches of paths (cpu/run_paths.h).
#pragma once

#include "core/kernel/integrator/holes.h"
#include "core/kernel/integrator/steps.h"

namespace pl {

/// The light sample at a vertex of a single path, for extend_path(). A class, because its call has to be inlined in kernels: else
/// the path's state is in memory there.
template <FeatureSet F, Method M>
struct LightAtOnce {
    const PathContext<M>& context;
    const Vec4f& u;
    PathState<F, M>& state;
    ShadowRequest<M>& shadow;

    PL_HD_INLINED void operator()(const ScatterPoint<F, M>& from) const {
        request_light(context, from, u, state, shadow);
    }
};

/// Shades the end of a path's segment, samples a light there, and scatters the path. `shadow` comes in cleared.
template <FeatureSet F, Method M>
PL_HD_INLINED PathStatus shade_segment(const PathContext<M>& context, const Hit& hit, PathState<F, M>& state,
                                       ShadowRequest<M>& shadow, PathCounters& counters) {
    const VertexNumbers numbers = draw_vertex_numbers<F>(context.settings, state);
    const LightAtOnce<F, M> request{context, numbers.light, state, shadow};
    return extend_path<F>(context, hit, numbers, state, request, counters);
}

/// Traces the shadow ray of a light sample, if there is one; the next branch follows the end of one. `status`: of shade_segment().
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
    return status == PathStatus::Finished ? finish_branch(context, state, counters) : status;
}

/// Traces one segment of a path, and the shadow ray at its end.
template <FeatureSet F, Method M, Intersector I>
PL_HD_INLINED PathStatus trace_segment(const PathContext<M>& context, const I& intersector, PathState<F, M>& state,
                                       PathCounters& counters) {
    const Hit hit = closest_solid_hit<F>(context.scene, intersector, state.ray);
    ShadowRequest<M> shadow;
    const PathStatus status = shade_segment<F>(context, hit, state, shadow, counters);
    return connect_segment<F>(context, intersector, shadow, status, state, counters);
}

/// `store`: the path's memory outside of its state.
template <FeatureSet F, Method M, Intersector I>
PL_HD inline void trace_path(const PathContext<M>& context, const I& intersector, PathState<F, M>& state,
                             PathStore<M>& store, PathCounters& counters) {
    keep_store(state, &store);
    PathStatus status = PathStatus::Continues;
    while (status == PathStatus::Continues) status = trace_segment<F>(context, intersector, state, counters);
}
template <FeatureSet F, Method M, Intersector I>
PL_HD inline void trace_path(const PathContext<M>& context, const I& intersector, PathState<F, M>& state,
                             PathCounters& counters) {
    PathStore<M> store;
    trace_path<F>(context, intersector, state, store, counters);
    drop_store(state);
}

}  // namespace pl
