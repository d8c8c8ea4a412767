// Emission along a path: its weight by multiple importance sampling, and the radiance of the environment.
#pragma once

#include "core/kernel/integrator/path.h"
#include "core/kernel/shading/lights.h"

namespace pl {

/// Balance-heuristic weight of emission in the path's direction; 1 if its last vertex sampled no lights. light_pdf_sa() is the
/// density of light sampling, per steradian.
template <FeatureSet F, class M, class Density>
PL_HD inline float direction_weight([[maybe_unused]] const PathSettings& settings,
                                    [[maybe_unused]] const PathState<F, M>& state,
                                    [[maybe_unused]] Density light_pdf_sa) {
    if constexpr (F.has(Feature::NextEventEstimation)) {
        if (settings.next_event != 0 && state.direction_pdf_sa > 0.0f)
            return balance_weight(state.direction_pdf_sa, light_pdf_sa());
    }
    return 1.0f;
}

/// Radiance of the environment in a direction.
template <FeatureSet F>
PL_HD inline Vec3f environment_radiance(const SceneView& scene, [[maybe_unused]] Vec3f direction) {
    Vec3f radiance{0.0f};
    if constexpr (F.has(Feature::Environment)) radiance = scene.environment;
    if constexpr (F.has(Feature::EnvironmentMap)) {
        if (!scene.far_lights.empty()) radiance += far_radiance(scene.far_lights, direction);
    }
    return radiance;
}

/// Adds the radiance of the environment to the path's estimator, weighted where the last vertex sampled far lights. Returns it, and
/// its share, as an observation of nothing else.
template <FeatureSet F, class M>
PL_HD inline Observation add_environment(const SceneView& scene, [[maybe_unused]] const PathSettings& settings,
                                         PathState<F, M>& state) {
    Observation far;
    if constexpr (F.has(Feature::Environment)) far.emitted = scene.environment;
    state.radiance += state.throughput * far.emitted;
    if constexpr (F.has(Feature::EnvironmentMap)) {
        if (scene.far_lights.empty()) return far;
        const FarDirection<One> direction = far_direction(scene.far_lights, state.ray.direction);
        const Vec3f map = pack(direction.radiance());
        if (is_black(map)) return far;
        const float weight =
            direction_weight(settings, state, [&] { return scene.far_probability * direction.pdf_sa(); });
        state.radiance += weight * (state.throughput * map);
        const float constant = rms(far.emitted);
        const float varying = rms(map);
        if (varying > 0.0f) far.direction_share = (constant + weight * varying) / (constant + varying);
        far.emitted += map;
    }
    return far;
}

}  // namespace pl
