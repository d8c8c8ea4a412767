// Which effects a scene calls for. Kernels are chosen by this set: what is not needed is not executed.
#pragma once

#include <string>
#include <vector>

#include "core/kernel/base/features.h"
#include "core/scene/scene_storage.h"

namespace pl {

/// Effects that the scene itself needs: smooth normals, environment light.
FeatureSet needed_effects(const HostScene& scene);

/// Stable names of the effects in a set, for `info` and `--stats`: "smooth-normals", "environment",
/// "next-event-estimation".
std::vector<std::string> effect_names(FeatureSet set);

}  // namespace pl
