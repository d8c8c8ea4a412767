// Settings for sessions that are compared to the bit: a small picture of odd size, a small field.
#pragma once

#include "tests/support/session/sessions.h"

namespace pl::test {

inline RenderSettings small_settings(const SceneDescription& scene, Estimator estimator, int width = 61,
                                     int height = 47) {
    RenderSettings settings = settings_for(scene, estimator, width, height);
    settings.field.volumes = 60;
    settings.field.bins = 64;
    settings.field.precompute_samples = 4;
    return settings;
}

/// The smallest picture here, for tests of many sessions.
inline RenderSettings tiny_settings(const SceneDescription& scene, bool next_event) {
    return small_settings(scene, {MethodId::Default, next_event}, 40, 30);
}

inline constexpr std::uint32_t kUsedPasses = 2;

/// A session in which every method has rendered, and precomputed or learned.
inline Session used_session(const SceneDescription& scene, const RenderSettings& settings,
                            const std::shared_ptr<RenderBackend>& backend = make_cpu_backend({.threads = 2})) {
    Session session(backend, std::make_shared<const SceneDescription>(scene), settings);
    for (const MethodInfo& method : all_methods()) render_passes(session, {method.id, View::Beauty}, kUsedPasses);
    return session;
}

/// Settings by which guided paths equal paths of the baseline, at a higher cost, so that guiding is given up: all directions by
/// the BSDF, roulette by the albedo. Smaller pictures have too few paths to see that their variance is the same.
inline RenderSettings settings_without_gain(const SceneDescription& scene, MethodId method) {
    RenderSettings settings = small_settings(scene, {method, true}, 80, 80);
    settings.guiding = GuidingRule::Paying;
    settings.mixture = {.learned = 0, .bsdf_fraction = 1.0f};
    settings.roulette = RouletteRule::Albedo;
    return settings;
}

}  // namespace pl::test
