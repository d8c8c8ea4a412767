// Picture files: EXR and PFM hold linear floats, PNG holds 8-bit display values.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

namespace pl {

/// Linear RGB radiance, [row][column] from the top.
struct LinearImage {
    int width = 0;
    int height = 0;
    std::vector<glm::vec3> pixels;
};

/// 8-bit sRGB, [row][column][channel] from the top.
struct ByteImage {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb;
};

/// Names and values stored with a picture, such as its render settings.
using ImageMetadata = std::vector<std::pair<std::string, std::string>>;

enum class ImageKind { Exr, Pfm, Png };

/// "exr", "pfm" or "png": also the extension.
constexpr std::string_view name_of(ImageKind kind) {
    switch (kind) {
    case ImageKind::Exr: return "exr";
    case ImageKind::Pfm: return "pfm";
    case ImageKind::Png: return "png";
    }
    return "";
}

/// Kind by file name extension, case-insensitive. Throws Error(Usage) that lists the known ones.
ImageKind image_kind(const std::filesystem::path& path);

// Writers are atomic (write_file_atomic). They throw Error(Runtime) with path and reason, also if the number of
// pixels is 0 or does not match width and height.

enum class ExrNumbers {
    Float,  ///< 32 bits
    Half,   ///< 16 bits, 11 of them significant; clamped to 65504
};

/// EXR, losslessly compressed. Metadata become attributes of type string (at most 100; names up to 255 bytes).
void write_exr(const std::filesystem::path& path, const LinearImage& image, const ImageMetadata& metadata = {},
               ExrNumbers numbers = ExrNumbers::Float);

/// PFM with little-endian floats; no metadata.
void write_pfm(const std::filesystem::path& path, const LinearImage& image);

/// PNG. Metadata become tEXt chunks; names are cut to 79 bytes, the limit of PNG.
void write_png8(const std::filesystem::path& path, const ByteImage& image, const ImageMetadata& metadata = {});

/// The value of the first entry with this name; empty if there is none.
std::string text_of(const ImageMetadata& metadata, const std::string& name);

// Readers throw Error(Input) if the file is missing, of another kind, or truncated. `metadata` receives the stored
// names and values.

/// EXR scanline files with channels R, G and B of any pixel type.
LinearImage read_exr(const std::filesystem::path& path, ImageMetadata* metadata = nullptr);

/// PFM color files ("PF") of either byte order.
LinearImage read_pfm(const std::filesystem::path& path);

/// EXR or PFM, by file name extension. 8-bit pictures are refused: tone-mapped and clipped values cannot be measured.
LinearImage read_linear(const std::filesystem::path& path, ImageMetadata* metadata = nullptr);

/// The bytes of a PNG file. Throws Error(Runtime) if the encoder fails.
std::string encode_png8(const ByteImage& image);

ByteImage read_png8(const std::filesystem::path& path, ImageMetadata* metadata = nullptr);

}  // namespace pl
