// Files for the texels of a scene, from which texture_file.h reads the same bits.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/scene/description.h"

namespace pl {

/// Writes the channels of a texture that a parameter of a material uses: color, first channel or opacity. PNG if its 8
/// bits hold every texel exactly, else EXR with floats. Returns `name` with the suffix. Throws Error(Runtime).
std::string write_texture(const std::filesystem::path& folder, const std::string& name,
                          const TextureDescription& texture, TextureContent use);

/// Writes the colors of vertices as the texels of an EXR image with floats, row by row from the top, and black ones up to its end. Throws
/// Error(Runtime).
void write_vertex_colors(const std::filesystem::path& path, const std::vector<glm::vec3>& colors);

/// Writes the radiance of the map as EXR with floats. Throws Error(Runtime).
void write_environment_map(const std::filesystem::path& path, const EnvironmentMapDescription& map);

}  // namespace pl
