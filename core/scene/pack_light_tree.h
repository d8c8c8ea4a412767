// Builds the tree over a scene's lights.
#pragma once

#include "core/scene/scene_storage.h"

namespace pl {

/// Up to so many triangles that emit are chosen by their power alone: a tree would not pay for its steps.
inline constexpr std::size_t kFewLights = 32;

/// Expects packed triangles, materials, lights and far lights. Leaves the tree empty where lights are few.
void pack_light_tree(HostScene& packed);

}  // namespace pl
