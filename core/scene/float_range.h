// Scenes where floats resolve them: near the origin, and of a size whose powers floats hold.
#pragma once

#include "core/scene/description.h"

namespace pl {

/// Moves a scene that is far from the origin for its size to it, and scales one that is huge or tiny to about 1. Both keep every position:
/// the difference of close floats is a float, and a power of two rounds nothing. Cameras, lights and absorption go along, radiance
/// stays. Expects a valid scene. A warning of the scene tells of either; most scenes keep every bit. Returns whether this one does not:
/// a camera or a light far from a tiny scene may then be beyond all floats.
bool move_into_float_range(SceneDescription& scene);

/// Adds a warning if the scene has a part so small for its place, or a camera so far away, that the steps of floats show.
void warn_of_float_steps(SceneDescription& scene);

}  // namespace pl
