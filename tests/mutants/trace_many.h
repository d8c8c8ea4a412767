// Running paths through the scalar loop of the kernel, one pixel, no threads.
#pragma once

#include "core/kernel/integrator/trace_path.h"
#include "core/scene/pack_scene.h"

namespace pl::test {

inline constexpr FeatureSet kWithNextEvent = FeatureSet{}.with(Feature::NextEventEstimation);

/// The unit cube of tests/support/scenes/cube_radiosity.h.
inline constexpr Vec3f kCubeLow{0.0f};
inline constexpr Vec3f kCubeHigh{1.0f};

struct Range {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

/// Samples of one pixel; `each(state, counters)` sees every finished path with its own counters.
template <FeatureSet F, class M, class Each>
void trace_many(const HostScene& scene, const CameraDescription& camera, const M& method,
                const PathSettings& settings, Range samples, Each&& each) {
    const SceneView view = scene.view();
    const BvhIntersector intersector{view};
    const Camera pinhole = make_camera(camera, 1, 1);
    for (std::uint32_t i = 0; i < samples.count; ++i) {
        PathCounters counters;
        auto state = begin_path<F, M>(pinhole, settings, 1, 1, 0, samples.first + i);
        trace_path<F>(view, intersector, method, settings, state, counters);
        each(state, counters);
    }
}

}  // namespace pl::test
