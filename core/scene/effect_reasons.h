// Why a scene needs an effect, in words for people: `info` and the viewer say the same.
#pragma once

#include <string>

#include "core/kernel/base/features.h"
#include "core/scene/description.h"

namespace pl {

/// "of 2 materials: mirror, window". Meant for effects that needed_features() names; `camera` is the one in use.
std::string reason_of(Feature feature, const SceneDescription& scene, const CameraDescription& camera);

}  // namespace pl
