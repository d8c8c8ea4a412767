// The reason a scene needs an effect, as text for `info` and the viewer.
#pragma once

#include <string>

#include "core/kernel/base/features.h"
#include "core/scene/description.h"

namespace pl {

/// An effect, and why a scene needs it.
struct EffectRow {
    std::string name;
    std::string reason;  ///< empty if it does not

    bool needed() const { return !reason.empty(); }
};

/// For example "of 2 materials: mirror, window". For effects of needed_effects(); `camera` is the current one.
std::string reason_of(Feature feature, const SceneDescription& scene, const CameraDescription& camera);

}  // namespace pl
