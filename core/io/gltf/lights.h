// Lights of a glTF file that no surface emits. [KHR_lights_punctual]
#pragma once

#include "core/io/gltf/nodes.h"
#include "core/scene/description.h"

namespace pl {

/// The first directional light of shown nodes becomes the sun; others are noted. Files of Blender's exporter give light in
/// lumens, 683 to a watt.
void add_gltf_lights(GltfFile& file, const GltfNodes& nodes, SceneDescription& scene);

}  // namespace pl
