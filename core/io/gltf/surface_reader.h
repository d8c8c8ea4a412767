// One material of a glTF file.
#pragma once

#include <string>

#include "core/io/gltf/material_values.h"
#include "core/io/gltf/surfaces.h"

namespace pl {

/// Where a value that is continuous in the file chooses between two kinds of surfaces.
inline constexpr float kGltfHalf = 0.5f;

/// Adds the material `number` of the file to the scene under this name, and behind it the metal that it blends with, if it does. Beyond
/// the materials of the file it is the standard of the format.
GltfSurface read_surface(GltfFile& file, SceneDescription& scene, GltfImages& images, std::uint32_t number,
                         const std::string& name);

}  // namespace pl
