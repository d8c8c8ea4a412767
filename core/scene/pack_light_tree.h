// Construction of the light tree of core/kernel/shading/light_tree.h.
#pragma once

#include "core/scene/scene_storage.h"

namespace pl {

/// Up to this number of emissive triangles, sampling by power alone is more efficient than a tree.
inline constexpr std::size_t kFewLights = 32;

/// Expects packed triangles, materials, lights and far lights. Up to kFewLights lights give an empty tree.
void pack_light_tree(HostScene& packed);

}  // namespace pl
