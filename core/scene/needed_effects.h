// The effects that a scene needs. Kernels are chosen by this set, so that absent effects cost nothing.
#pragma once

#include <string>
#include <vector>

#include "core/kernel/base/features.h"
#include "core/scene/description.h"
#include "core/scene/scene_storage.h"

namespace pl {

/// Effects of geometry, materials and lights; without those of settings and camera.
FeatureSet needed_effects(const HostScene& scene);
/// Effects of the camera.
FeatureSet needed_effects(const CameraDescription& camera);

/// Stable names of the effects in a set, in the order of kAllFeatures.
std::vector<std::string> effect_names(FeatureSet set);

}  // namespace pl
