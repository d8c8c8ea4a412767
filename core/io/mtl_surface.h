// What an MTL entry means: docs/materials.md has the table.
#pragma once

#include <string>
#include <vector>

#include "core/io/mtl_entry.h"
#include "core/scene/description.h"

namespace pl {

/// What is shown where the file gives no material: a soft magenta that no real surface has, so that it is noticed.
inline constexpr glm::vec3 kDefaultAlbedo{0.70f, 0.45f, 0.70f};

/// Roughness below this counts as 0: such a surface looks like a mirror.
inline constexpr float kLeastRoughness = 0.03f;

/// Roughness of the GGX lobe that is about as wide as a Phong lobe of this exponent: alpha = sqrt(2 / (Ns + 2)),
/// whose root it is. [Walter et al. 2007, section 5.2]
float roughness_of_exponent(float ns);

/// Kind, colors and numbers of a material, without its textures. `notes` receives what the file asks for and is not
/// shown.
MaterialDescription surface_of(const MtlEntry& entry, std::vector<std::string>& notes);

}  // namespace pl
