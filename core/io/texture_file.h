// Image files as textures and environment maps: PNG, JPEG, TGA, BMP (8 and 16 bits), Radiance HDR, PFM, EXR.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/scene/description.h"

namespace pl {

/// Largest side, and most texels, of a texture.
inline constexpr std::uint32_t kMostTextureSide = 16384;
inline constexpr std::size_t kMostTexels = std::size_t{1} << 26;

/// Reads an image file, the kind by its suffix. LDR colors are decoded from sRGB [IEC 61966-2-1]; numbers and
/// opacities are taken as they are. Texels of HDR files that are NaN, infinite or negative become 0, with one counted
/// warning. Throws Error(Input): missing, not of a known kind, damaged, too large.
TextureDescription read_texture(const std::filesystem::path& path, TextureContent content, bool repeats,
                                std::vector<std::string>& warnings);

/// Adds a texture to a scene, or finds it if the same file is there already; returns its index. What cannot be read
/// is told in a warning, and shown as magenta and black checkers if it should give colors; else the result is
/// kNoTexture.
std::uint32_t add_texture(SceneDescription& scene, const std::filesystem::path& path, TextureContent content,
                          bool repeats);

/// An image over all directions, twice as wide as high (others are stretched), its radiance multiplied by `scale`.
/// Throws Error(Input) as read_texture() does.
EnvironmentMapDescription read_environment_map(const std::filesystem::path& path, float scale, float rotation_deg,
                                               std::vector<std::string>& warnings);

/// A name in a scene or material file as a path, with slashes of either kind; empty if it is absolute or leads out of
/// the folder.
std::filesystem::path path_inside(const std::filesystem::path& folder, const std::string& name);

}  // namespace pl
