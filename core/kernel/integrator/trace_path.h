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

/// Traces one segment of a path, and the shadow ray at its end. The next branch follows the end of one.
template <FeatureSet F, Method M, Intersector I>
PL_HD_INLINED PathStatus trace_segment(const PathContext<M>& context, const I& intersector, PathState<F, M>& state,
                                       PathCounters& counters) {
    const Hit hit = closest_solid_hit<F>(context.scene, intersector, state.ray);
    const VertexNumbers numbers = draw_vertex_numbers<F>(context.settings, state);
    ShadowRequest<M> shadow;
    const LightAtOnce<F, M> request{context, numbers.light, state, shadow};
    PathStatus status = extend_path<F>(context, hit, numbers, state, request, counters);
    if constexpr (F.has(Feature::NextEventEstimation)) {
        bool is_visible = false;
        if (shadow.wanted) {
            ++counters.shadow_rays;
            is_visible = !is_blocked<F>(context.scene, intersector, shadow.ray);
            if (is_visible) connect_light(context.method, shadow, state, counters);
        }
        context.method.record_light(shadow.light, is_visible);
    }
    if (status == PathStatus::Finished) status = finish_branch(context, state, counters);
    return status;
}

/// `store`: for what the path keeps outside of its state.
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
