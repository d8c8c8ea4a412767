// Do radiance volumes stay where they are when materials of a scene change?
#pragma once

#include "core/scene/scene_storage.h"

namespace pl {

/// True only if place_volumes() puts the same volumes into both scenes, which differ in materials alone. It may be false
/// although it does: only what placing does not look at at all is known to make no difference, such as the color of a
/// surface that stays diffuse.
bool same_placement(const HostScene& before, const HostScene& after);

}  // namespace pl
