// Materials of an MTL file, with their textures.
#pragma once

#include <filesystem>

#include "core/io/mtl_surface.h"
#include "core/scene/description.h"

namespace pl {

/// Adds the materials of an MTL file to a scene, in its order of `newmtl`, and the textures they use.
///   Kd r g b          linear reflectance; one number means gray; clamped to [0, 1] with a warning
///   Ke r g b          linear emitted radiance of the front side; a material may both reflect and emit
///   Ks Ns Ni d Tr Tf illum Pr Pm Pc, our own Pl_surface Pl_roughness Pl_ior    kind of surface: docs/materials.md
///   map_Kd map_Ke map_Pr map_Ns map_d    images in the folder of the file or below; the option -clamp on
///   Pl_two_sided 0|1  emission from the back side too
/// A material with no color at all has kDefaultAlbedo; of two with one name the first counts; both with a warning. What
/// would change the picture and is left out is told in warnings; so are textures that cannot be read.
/// Throws Error(Input) with file and line for values of Kd, Ke and our own keys that are negative or no finite
/// numbers.
void load_mtl(const std::filesystem::path& path, SceneDescription& scene);

}  // namespace pl
