// Images and image coordinates for the kernels.
#pragma once

#include "core/scene/description.h"
#include "core/scene/scene_storage.h"

namespace pl {

/// Packs the images that materials of triangles use, and the coordinates of all triangles: those without any are at
/// (0, 0). Leaves all arrays empty if there is no such material. Images that change nothing are left out: opacity
/// that is nowhere below one half, factors of 0. Material::emission becomes the mean over its image, so that lights
/// can be chosen by it. Expects packed materials.
void pack_textures(const SceneDescription& scene, HostScene& packed);

}  // namespace pl
