// Texels of image files of all kinds: PNG, JPEG, TGA, BMP (8 and 16 bits), Radiance HDR, PFM, EXR.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "core/io/image.h"

namespace pl {

// Detection of truncated image files before decoding: the decoder reads missing bytes as black or gray.

/// Whether a JPEG, TGA or BMP file is too short for an image of this size. False for
/// other kinds, whose decoders detect it.   [ITU-T T.81, B.1; Truevision TGA 2.0, sections 2 to 4]
bool ends_early(ImageKind kind, std::string_view file, std::size_t width, std::size_t height);

/// Largest width or height, and largest number of texels, of a texture.
inline constexpr std::uint32_t kMostTextureSide = 16384;
inline constexpr std::size_t kMostTexels = std::size_t{1} << 26;

/// Texels as stored, [row][column] from the top: in [0, 1] for LDR files; alpha is 1 if the file has none.
struct DecodedImage {
    int width = 0;
    int height = 0;
    bool is_ldr = true;
    std::vector<glm::vec4> texels{};
};

/// Decodes the bytes of a file, its kind by image_kind_of(). `path` is for messages. Throws Error(Input) if the file is
/// of unknown kind, damaged, or too large.
DecodedImage decode_image(const std::string& bytes, const std::filesystem::path& path,
                          std::vector<std::string>& warnings);

}  // namespace pl
