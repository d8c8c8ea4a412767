// Images, opacities and texture coordinates for the kernels.
#pragma once

#include "core/scene/description.h"
#include "core/scene/scene_storage.h"

namespace pl {

/// Packs the opacities and images of the materials in use and the texture coordinates of all triangles, (0, 0) where they have
/// none. All arrays stay empty if no material in use has an image or holes. Images without effect are omitted: opacity of opaque
/// surfaces, images that multiply 0. Material::emission is multiplied by the mean of its image, so that
/// lights are sampled by it. Expects packed materials.
void pack_textures(const SceneDescription& scene, HostScene& packed);

}  // namespace pl
