// Textures: images of files as they are sampled, heights as normals, and the way back to a file.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "core/scene/description.h"

namespace pl {

// Textures and environment maps from image files of any kind that decode_image() knows.

/// Linear value of an sRGB value, both in [0, 1]. [IEC 61966-2-1]
float decode_srgb(float code);

/// Reads an image file. LDR colors are decoded from sRGB [IEC 61966-2-1]; numbers and
/// opacities are linear. Texels of HDR files that are NaN, infinite or negative become 0, with one counted warning.
/// Throws Error(Input) for a file that is missing, of unknown kind, corrupt, or too large.
TextureDescription read_texture(const std::filesystem::path& path, TextureContent content, bool repeats,
                                std::vector<std::string>& warnings);

/// As read_texture() for the bytes of a file; `source` is for messages, and becomes the source of the texture.
TextureDescription decode_texture(const std::string& bytes, const std::filesystem::path& source,
                                  TextureContent content, bool repeats, std::vector<std::string>& warnings);

/// Index of the texture that `read` gives, added to the scene. If `read` throws an Error(Input) other than a MemoryError, adds a warning and
/// returns a checkerboard of magenta and black for colors, kNoTexture for other contents.
std::uint32_t add_texture_by(SceneDescription& scene, const std::filesystem::path& source, TextureContent content,
                             bool repeats, const std::function<TextureDescription()>& read);

/// Index of the texture of a file in the scene, added by add_texture_by() if it is new.
std::uint32_t add_texture(SceneDescription& scene, const std::filesystem::path& path, TextureContent content,
                          bool repeats);

/// Reads an environment map; images that are not twice as wide as high are stretched. `scale` multiplies the
/// radiance. Throws Error(Input) as read_texture() does.
EnvironmentMapDescription read_environment_map(const std::filesystem::path& path, float scale, float rotation_deg,
                                               std::vector<std::string>& warnings);

/// Path of a file name in a scene or material file, with slashes of either kind; empty if it is absolute or outside
/// of the folder, also by a link.
std::filesystem::path path_inside(const std::filesystem::path& folder, const std::string& name);

// Heights as normals: images of reliefs that other programs know as bump maps.

/// Replaces the heights in an image, its first channel, by the unit normals of their relief, as an image of normals holds them: by central
/// differences between neighboring texels, those beyond an edge being the wrapped or the clamped ones. `rise`: the height of the value 1
/// in texels along u and v, which differ where an image is stretched. Slopes that are not finite count as none.
///   [Blinn 1978, "Simulation of Wrinkled Surfaces"]
void turn_into_normals(TextureDescription& heights, glm::vec2 rise);

// Files for the texels of a scene, from which texture_file.h reads the same bits.

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
