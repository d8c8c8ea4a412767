// MTL materials as materials of a scene.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/io/load_settings.h"
#include "core/io/mtl_entry.h"
#include "core/scene/description.h"

namespace pl {

// Interpretation of MTL entries as materials; docs/materials.md has the table.

/// Albedo of surfaces without a material: a soft magenta that is noticed, because no real surface has it.
inline constexpr glm::vec3 kDefaultAlbedo{0.70f, 0.45f, 0.70f};

/// Roughness below this counts as 0: the surface looks like a mirror.
inline constexpr float kLeastRoughness = 0.03f;

/// Below this index an interface is smooth: without refraction the half vector of a rough one is undefined.
inline constexpr float kLeastRoughIor = 1.05f;

/// Roughness sqrt(alpha) of the GGX lobe of about the width of a Phong lobe with exponent Ns: alpha = sqrt(2 / (Ns +
/// 2)). [Walter et al. 2007, section 5.2]
float roughness_of_exponent(float ns);

/// Whether an entry, if it lets light through, has the model, the filter color or the index of refraction of glass.
bool may_be_glass(const MtlEntry& entry);

/// Kind, colors and numbers of a material, without its textures. `notes` receives the features that are not
/// supported.
MaterialDescription surface_of(const MtlEntry& entry, std::vector<std::string>& notes);

// Materials of an MTL file, with their textures.

/// Adds the materials of an MTL file to a scene, in the order of `newmtl`, and their textures.
///   Kd r g b          linear reflectance; one number means gray; clamped to [0, 1] with a warning
///   Ke r g b          linear emitted radiance of the front side; a material may both reflect and emit
///   Ks Ns Ni d Tr Tf illum Pr Pm Pc, our own Pl_surface Pl_roughness Pl_ior    kind of surface: docs/materials.md
///   map_Kd map_Ke map_Pr map_Ns map_d norm bump    images in the scene's folder or below: find_named_file(); the options -s, -o,
///                     -clamp and -bm
///   Pl_two_sided 0|1  emission from the back side too
/// A material without any color has kDefaultAlbedo; of two materials with the same name the first counts. Both give a
/// warning, as do ignored statements that would change the picture and textures that cannot be read.
/// With MapKd::Replaces an image of Kd is multiplied by 1. With MapKd::Multiplies one warning tells of materials whose Kd is a
/// default of exporters.
/// The scene's folder is the folder of scene.source, or of the file if there is none. Returns, for each material that
/// was added, the place of its images, which the caller gives to the texture coordinates; of images in several places
/// the first counts, with a warning. Throws Error(Input) for a file that is no text.
std::vector<UvScale> load_mtl(const std::filesystem::path& path, SceneDescription& scene,
                              MapKd map_kd = MapKd::Multiplies);

}  // namespace pl
