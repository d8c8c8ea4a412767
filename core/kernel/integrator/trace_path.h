// The main loop: one path from its first segment to its end.
#pragma once

#include "core/kernel/geometry/intersector.h"
#include "core/kernel/integrator/steps.h"

namespace pl {

template <FeatureSet F, Method M, Intersector I>
PL_HD inline void trace_path(const SceneView& scene, const I& intersector, const M& method,
                             const PathSettings& settings, PathState<M>& state, PathCounters& counters) {
    PathStatus status = PathStatus::Continues;
    while (status == PathStatus::Continues) {
        const Hit hit = intersector.closest_hit(state.ray);
        const VertexNumbers numbers = draw_vertex_numbers<F>(settings, state);
        ShadowRequest shadow;
        status = extend_path<F>(scene, method, settings, hit, numbers, state, shadow, counters);
        if (shadow.wanted) {
            ++counters.shadow_rays;
            if (!intersector.occluded(shadow.ray)) connect_light(shadow, state);
        }
    }
}

}  // namespace pl
