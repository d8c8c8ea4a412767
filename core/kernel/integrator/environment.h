// Weights of light that a path meets, and what it meets where it leaves the scene.
#pragma once

#include "core/kernel/integrator/path.h"
#include "core/kernel/shading/lights.h"

namespace pl {

/// Light from outside, in one direction.
struct FarArrival {
    Vec3f radiance{0.0f};
    float share = 1.0f;  ///< that the path's direction brings; see Arrival::light_share
};

/// Weight of light that the path's direction met. Where its last vertex sampled lights too, the two strategies share it;
/// light_pdf_sa() is the density of the other one.
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

/// Light from outside, as the path sees it. Where the previous vertex sampled far lights too, the two strategies
/// share them.
template <FeatureSet F, class M>
PL_HD inline FarArrival add_environment(const SceneView& scene, [[maybe_unused]] const PathSettings& settings,
                                        PathState<F, M>& state) {
    FarArrival arrival;
    if constexpr (F.has(Feature::Environment)) arrival.radiance = scene.environment;
    state.radiance += state.throughput * arrival.radiance;
    if constexpr (F.has(Feature::EnvironmentMap)) {
        if (scene.far_lights.empty()) return arrival;
        const Vec3f far = far_radiance(scene.far_lights, state.ray.direction);
        if (is_black(far)) return arrival;
        const float weight =
            direction_weight(settings, state, [&] { return far_light_pdf_sa(scene, state.ray.direction); });
        state.radiance += weight * (state.throughput * far);
        const float constant = luminance(arrival.radiance);
        const float varying = luminance(far);
        if (varying > 0.0f) arrival.share = (constant + weight * varying) / (constant + varying);
        arrival.radiance += far;
    }
    return arrival;
}

}  // namespace pl
