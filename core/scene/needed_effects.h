// The effects that a scene needs, and why. Kernels are chosen by this set, so that absent effects cost nothing.
#pragma once

#include <string>
#include <vector>

#include "core/kernel/base/features.h"
#include "core/scene/description.h"
#include "core/scene/scene_storage.h"

namespace pl {

/// Effects of geometry, materials and lights; without the effects of settings and camera.
FeatureSet needed_effects(const HostScene& scene);
/// Effects of the camera.
FeatureSet needed_effects(const CameraDescription& camera);

/// Stable names of the effects in a set, in the order of kAllFeatures.
std::vector<std::string> effect_names(FeatureSet set);

/// An effect, and why a scene needs it.
struct EffectRow {
    std::string name;
    std::string reason;  ///< empty if it does not

    bool needed() const { return !reason.empty(); }
};

/// The reason a scene needs an effect, for `info` and the viewer: "of 2 materials: mirror, window". For effects of needed_effects(); `camera` is the current one.
std::string reason_of(Feature feature, const SceneDescription& scene, const CameraDescription& camera);

}  // namespace pl
