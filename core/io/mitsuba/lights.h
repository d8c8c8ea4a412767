// Emitters of a Mitsuba scene without extent: point, spot and directional.
#pragma once

#include "core/io/mitsuba/xml_file.h"
#include "core/scene/description.h"

namespace pl {

/// Returns false, and adds nothing, for another type. Throws Error(Input) with file and line for values that make no light.
bool add_mitsuba_light(const MitsubaObject& emitter, SceneDescription& scene);

}  // namespace pl
