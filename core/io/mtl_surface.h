// Interpretation of MTL entries as materials; docs/materials.md has the table.
#pragma once

#include <string>
#include <vector>

#include "core/io/mtl_entry.h"
#include "core/scene/description.h"

namespace pl {

/// Albedo of surfaces without a material: a soft magenta that is noticed, because no real surface has it.
inline constexpr glm::vec3 kDefaultAlbedo{0.70f, 0.45f, 0.70f};

/// Roughness below this counts as 0: the surface looks like a mirror.
inline constexpr float kLeastRoughness = 0.03f;

/// Below this index an interface is smooth: without refraction the half vector of a rough one is undefined.
inline constexpr float kLeastRoughIor = 1.05f;

/// Roughness sqrt(alpha) of the GGX lobe of about the width of a Phong lobe with exponent Ns: alpha = sqrt(2 / (Ns +
/// 2)). [Walter et al. 2007, section 5.2]
float roughness_of_exponent(float ns);

/// Whether the model, the filter color or the index of refraction of an entry are those of glass, if it lets light through.
bool may_be_glass(const MtlEntry& entry);

/// Kind, colors and numbers of a material, without its textures. `notes` receives the features that are not
/// supported.
MaterialDescription surface_of(const MtlEntry& entry, std::vector<std::string>& notes);

}  // namespace pl
