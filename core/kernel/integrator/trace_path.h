// The main loop: one path from its first segment to its end.
#pragma once

#include "core/kernel/integrator/holes.h"
#include "core/kernel/integrator/steps.h"

namespace pl {

/// One segment of a path, with the shadow ray at its end. Where a branch ends the next one has begun.
template <FeatureSet F, Method M, Intersector I>
PL_HD inline PathStatus trace_segment(const SceneView& scene, const I& intersector, const M& method,
                                      const PathSettings& settings, PathState<F, M>& state, PathCounters& counters) {
    const Hit hit = closest_solid_hit<F>(scene, intersector, state.ray);
    const VertexNumbers numbers = draw_vertex_numbers<F>(settings, state);
    ShadowRequest shadow;
    PathStatus status = extend_path<F>(scene, method, settings, hit, numbers, state, shadow, counters);
    if constexpr (F.has(Feature::NextEventEstimation)) {
        if (shadow.wanted) {
            ++counters.shadow_rays;
            if (!is_blocked<F>(scene, intersector, shadow.ray)) connect_light(method, shadow, state, counters);
        }
    }
    if (status == PathStatus::Finished) status = end_branch(scene, method, settings, state, counters);
    return status;
}

template <FeatureSet F, Method M, Intersector I>
PL_HD inline void trace_path(const SceneView& scene, const I& intersector, const M& method,
                             const PathSettings& settings, PathState<F, M>& state, PathCounters& counters) {
    PathStatus status = PathStatus::Continues;
    while (status == PathStatus::Continues)
        status = trace_segment<F>(scene, intersector, method, settings, state, counters);
}

}  // namespace pl
