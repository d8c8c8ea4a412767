// Instances as kernels read them.
#pragma once

#include "core/scene/description.h"
#include "core/scene/scene_storage.h"

namespace pl {

/// Bound on the edges of all triangles of instances; `triangles`: those of the scene, packed. 0 without instances.
double longest_instance_edge(const SceneDescription& scene, Span<const Triangle> triangles);

/// Packs transformations, and the hierarchies of meshes and of instances. Expects packed triangles.
void pack_instances(const SceneDescription& scene, HostScene& packed);

}  // namespace pl
