// Environment map and sun for the kernels: what light samples are chosen by.
#pragma once

#include "core/scene/description.h"
#include "core/scene/scene_storage.h"

namespace pl {

/// Packs the map, if any of it is bright, with its cumulative probabilities, and the sun. Far lights are chosen by
/// what crosses a unit area that faces them; between them and the surfaces that emit the choice is by power, far
/// light being what crosses the disc that the scene shows it, and leaves each at least a tenth of the samples.
/// Expects packed triangles and lights. SceneView::light_power becomes larger by the share of the samples that lights
/// do not get, so that their densities need not know of it.
void pack_far_lights(const SceneDescription& scene, HostScene& packed);

}  // namespace pl
