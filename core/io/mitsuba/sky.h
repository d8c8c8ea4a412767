// Sky and sun of Mitsuba scenes.
#pragma once

#include "core/io/mitsuba/xml_file.h"
#include "core/scene/description.h"

namespace pl {

/// Adds the sky and the sun of an emitter of the type sunsky, and of sky and sun of 0.6. Returns false, and adds nothing, for another
/// type. Throws Error(Input) with file and line for values that make none. [Mitsuba 3, sunsky; 0.6, sky, sun and sunsky]
bool add_mitsuba_sky(const MitsubaObject& emitter, SceneDescription& scene);

}  // namespace pl
