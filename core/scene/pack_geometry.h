// Triangles as kernels read them: corners, planes, normals, and the hierarchy.
#pragma once

#include "core/scene/description.h"
#include "core/scene/scene_storage.h"

namespace pl {

/// Packs all that depends on corners and normals alone. The scene must be valid.
void pack_geometry(const SceneDescription& scene, HostScene& packed);

}  // namespace pl
