// Textures and environment maps from image files of any kind that decode_image() knows.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/scene/description.h"

namespace pl {

/// Linear value of an sRGB value, both in [0, 1]. [IEC 61966-2-1]
float decode_srgb(float code);

/// Reads an image file. LDR colors are decoded from sRGB [IEC 61966-2-1]; numbers and
/// opacities are linear. Texels of HDR files that are NaN, infinite or negative become 0, with one counted warning.
/// Throws Error(Input) for a file that is missing, of unknown kind, corrupt, or too large.
TextureDescription read_texture(const std::filesystem::path& path, TextureContent content, bool repeats,
                                std::vector<std::string>& warnings);

/// As read_texture() for the bytes of a file; `source` is for messages, and becomes that of the texture.
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

}  // namespace pl
