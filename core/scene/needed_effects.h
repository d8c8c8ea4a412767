// Which effects a scene calls for. Kernels are chosen by this set: what is not needed is not executed.
#pragma once

#include <string>
#include <vector>

#include "core/kernel/base/features.h"
#include "core/scene/description.h"
#include "core/scene/scene_storage.h"

namespace pl {

/// Effects that the scene itself needs; not those that settings or the camera ask for.
FeatureSet needed_effects(const HostScene& scene);
/// Those that the camera needs.
FeatureSet needed_effects(const CameraDescription& camera);

/// Stable names of the effects in a set, in the order of kAllFeatures, for `info`, `--stats` and `--force-effects`:
/// "smooth-normals", "environment", "next-event-estimation", "specular", "rough", "plastic", "textures", "cut-outs",
/// "environment-map", "thin-lens", "many-lights".
std::vector<std::string> effect_names(FeatureSet set);

}  // namespace pl
