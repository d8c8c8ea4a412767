// Heights as normals: images of reliefs that other programs know as bump maps.
#pragma once

#include <glm/glm.hpp>

#include "core/scene/description.h"

namespace pl {

/// Replaces the heights in an image, its first channel, by the unit normals of their relief, as an image of normals holds them: by central
/// differences between neighboring texels, those beyond an edge being the wrapped or the clamped ones. `rise`: the height of the value 1
/// in texels along u and v, which differ where an image is stretched. Slopes that are not finite count as none.
///   [Blinn 1978, "Simulation of Wrinkled Surfaces"]
void turn_into_normals(TextureDescription& heights, glm::vec2 rise);

}  // namespace pl
