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

/// Settings by which guided paths are those of the baseline, at a higher cost, so that guiding is given up: all directions by
/// the BSDF, roulette by the albedo.
inline RenderSettings settings_without_gain(const SceneDescription& scene, MethodId method) {
    RenderSettings settings = small_settings(scene, {method, true}, 40, 40);
    settings.guiding = GuidingRule::Paying;
    settings.mixture = {.learned = 0, .bsdf_fraction = 1.0f};
    settings.roulette = RouletteRule::Albedo;
    return settings;
}

}  // namespace pl::test
