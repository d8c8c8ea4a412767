// Materials of an MTL file: Kd (reflectance), Ke (emission), and our own key Pl_two_sided.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "core/scene/description.h"

namespace pl {

/// What is shown where the file gives no material: a soft magenta that no real surface has, so that it is noticed.
inline constexpr glm::vec3 kDefaultAlbedo{0.70f, 0.45f, 0.70f};

/// Reads an MTL file in its order of `newmtl`.
///   Kd r g b          linear reflectance; one number means gray; clamped to [0, 1] with a warning
///   Ke r g b          linear emitted radiance of the front side; a material may both reflect and emit
///   Pl_two_sided 0|1  emission from the back side too
/// A material with neither Kd nor Ke has kDefaultAlbedo; of two with one name the first counts; both with a warning.
/// Everything else is left out; what would change the picture (maps, transparency) with one warning.
/// Throws Error(Input) with file and line for values that are negative or no finite numbers.
std::vector<MaterialDescription> load_mtl(const std::filesystem::path& path, std::vector<std::string>& warnings);

}  // namespace pl
