// Cameras of a glTF file.
#pragma once

#include "core/io/gltf/nodes.h"
#include "core/scene/description.h"

namespace pl {

/// Lists the perspective cameras of shown nodes in SceneDescription::cameras, under the names of their nodes. Expects the
/// triangles of the scene.
void add_gltf_cameras(GltfFile& file, const GltfNodes& nodes, SceneDescription& scene);

}  // namespace pl
