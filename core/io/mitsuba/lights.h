// Emitters of a Mitsuba scene that are no shapes: environment maps, and points, spots and directions without extent.
#pragma once

#include "core/io/mitsuba/xml_file.h"
#include "core/scene/description.h"

namespace pl {

/// The map of an emitter of the type envmap, turned, tilted and mirrored as it is. Throws Error(Input) as read_texture() does, and for a
/// place without a direction. [Mitsuba 3, envmap]
EnvironmentMapDescription mitsuba_map(const MitsubaObject& emitter, std::vector<std::string>& warnings);

/// Returns false, and adds nothing, for another type. Throws Error(Input) with file and line for values that make no light.
bool add_mitsuba_light(const MitsubaObject& emitter, SceneDescription& scene);

// Sky and sun of Mitsuba scenes.

/// Adds the sky and the sun of an emitter of the type sunsky, and of sky and sun of 0.6. Returns false, and adds nothing, for another
/// type. Throws Error(Input) with file and line for values that make none. [Mitsuba 3, sunsky; 0.6, sky, sun and sunsky]
bool add_mitsuba_sky(const MitsubaObject& emitter, SceneDescription& scene);

}  // namespace pl
