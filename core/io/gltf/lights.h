// Lights of a glTF file that no surface emits. [KHR_lights_punctual]
#pragma once

#include "core/io/gltf/nodes.h"
#include "core/scene/description.h"

namespace pl {

/// The lights of shown nodes. Candela count as W/sr and lux as W/m^2, as the radiance of emissive surfaces does; files of Blender's
/// exporter give light in lumens, 683 to a watt. Ranges are noted: the light of points and spots has none.
void add_gltf_lights(GltfFile& file, const GltfNodes& nodes, SceneDescription& scene);

}  // namespace pl
