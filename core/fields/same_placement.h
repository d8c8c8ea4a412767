// Test whether a change of materials keeps the placement of the radiance volumes.
#pragma once

#include "core/scene/scene_storage.h"

namespace pl {

/// Whether place_volumes() returns the same volumes for both scenes, which differ in materials alone. Conservative:
/// true only if every changed property is one that placement does not read, such as the color of a surface that stays
/// diffuse.
bool same_placement(const HostScene& before, const HostScene& after);

}  // namespace pl
