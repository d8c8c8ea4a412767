// The lights that paths sample, by the scene and the settings.
#pragma once

#include "core/kernel/integrator/path.h"
#include "core/kernel/scene/scene_view.h"

namespace pl {

/// A scene and the settings of paths through it.
struct SampledScene {
    SceneView scene;
    PathSettings path;
};

/// Without light samples the samples of delta lights remain, since no path finds these lights in another way: all
/// other lights then have the density 0 of being sampled, and emission that paths hit has the weight 1.
inline SampledScene with_delta_lights(SceneView scene, PathSettings path) {
    if (path.next_event != 0 || scene.delta_lights.empty()) return {scene, path};
    path.next_event = 1;
    scene.light_power = 0.0f;
    scene.light_tree = {};
    scene.far_probability = 0.0f;
    scene.delta_probability = 1.0f;
    return {scene, path};
}

}  // namespace pl
