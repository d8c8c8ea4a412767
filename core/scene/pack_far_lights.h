// Environment map and sun for the kernels, with their sampling distributions.
#pragma once

#include "core/scene/description.h"
#include "core/scene/scene_storage.h"

namespace pl {

/// Packs the map, unless it is black, with its cumulative probabilities, and the sun. Map and sun are sampled in
/// proportion to their irradiance; far lights and emissive triangles in proportion to their power, at least a tenth
/// of the samples each, with pi r^2 of the scene's bounding sphere as the receiving area of the far lights.
/// Expects packed triangles and lights. Divides SceneView::light_power by the probability of sampling `lights`, so
/// that the densities of lights include it. Returns the power of the far lights, divided by pi.
double pack_far_lights(const SceneDescription& scene, HostScene& packed);

/// Packs the lights without extent. The others and they are sampled in proportion to their power, at least a tenth of the samples
/// each. `far_power`: of pack_far_lights(), which must have run. Scales the probabilities of the others.
void pack_delta_lights(const SceneDescription& scene, double far_power, HostScene& packed);

}  // namespace pl
