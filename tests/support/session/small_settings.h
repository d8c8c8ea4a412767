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

}  // namespace pl::test
