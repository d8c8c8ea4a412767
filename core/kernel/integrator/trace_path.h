// The loop over one path: the integrator from beginning to end. A GPU thread runs it (cuda/kernels/trace.cuh), and so do tests
// and the search for diagnostics; on the CPU, pictures run the same steps over batches of paths (cpu/run_paths.h).
#pragma once

#include "core/kernel/integrator/holes.h"
#include "core/kernel/integrator/steps.h"

namespace pl {

/// Traces one segment of a path, and the shadow ray at its end. The next branch follows the end of one.
template <FeatureSet F, Method M, Intersector I>
PL_HD inline PathStatus trace_segment(const PathContext<M>& context, const I& intersector, PathState<F, M>& state,
                                      PathCounters& counters) {
    const Hit hit = closest_solid_hit<F>(context.scene, intersector, state.ray);
    const VertexNumbers numbers = draw_vertex_numbers<F>(context.settings, state);
    ShadowRequest<M> shadow;
    PathStatus status = extend_path<F>(context, hit, numbers, state, shadow, counters);
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

template <FeatureSet F, Method M, Intersector I>
PL_HD inline void trace_path(const PathContext<M>& context, const I& intersector, PathState<F, M>& state,
                             PathCounters& counters) {
    ForkMemory<M> forks;
    keep_forks(state, &forks);
    PathStatus status = PathStatus::Continues;
    while (status == PathStatus::Continues) status = trace_segment<F>(context, intersector, state, counters);
    keep_forks<F, M>(state, nullptr);  // their memory ends here
}

}  // namespace pl
