// Pictures in files: EXR and PFM hold linear floats, PNG holds what is shown.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

namespace pl {

/// Linear RGB radiance, row by row from the top.
struct LinearImage {
    int width = 0;
    int height = 0;
    std::vector<glm::vec3> pixels;
};

/// 8-bit sRGB, three bytes per pixel, row by row from the top.
struct ByteImage {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb;
};

/// Name and text of what is told along with a picture, such as the settings it was made with.
using ImageMetadata = std::vector<std::pair<std::string, std::string>>;

enum class ImageKind { Exr, Pfm, Png };

/// Kind by suffix, in any case. Throws Error(Usage) that lists the known suffixes.
ImageKind image_kind(const std::filesystem::path& path);

// Writers appear under their name only when complete (write_file_atomic). They throw Error(Runtime) with path and
// reason, also for an image without pixels or with the wrong number of them.

enum class ExrNumbers {
    Float,  ///< 32 bits
    Half,   ///< 16 bits: three digits; what exceeds 65504, the largest one, is stored as that
};

/// Losslessly compressed. Metadata become attributes of type string (at most 100; names up to 255 bytes).
void write_exr(const std::filesystem::path& path, const LinearImage& image, const ImageMetadata& metadata = {},
               ExrNumbers numbers = ExrNumbers::Float);

/// 32-bit little-endian floats, no metadata.
void write_pfm(const std::filesystem::path& path, const LinearImage& image);

/// Metadata become tEXt chunks; names are cut to the 79 bytes that PNG allows.
void write_png8(const std::filesystem::path& path, const ByteImage& image, const ImageMetadata& metadata = {});

/// The text of the first entry of this name; empty if there is none.
std::string text_of(const ImageMetadata& metadata, const std::string& name);

// Readers throw Error(Input): missing, not of this kind, truncated. `metadata` receives what the writers stored.

/// Scanline files with channels R, G and B of any pixel type.
LinearImage read_exr(const std::filesystem::path& path, ImageMetadata* metadata = nullptr);

/// Color files ("PF") of either byte order.
LinearImage read_pfm(const std::filesystem::path& path);

/// Either of them, by suffix; 8-bit pictures are refused: what is tone mapped and clipped measures nothing.
LinearImage read_linear(const std::filesystem::path& path, ImageMetadata* metadata = nullptr);

/// The bytes of a PNG file. Throws Error(Runtime) if the encoder fails.
std::string encode_png8(const ByteImage& image);

ByteImage read_png8(const std::filesystem::path& path, ImageMetadata* metadata = nullptr);

}  // namespace pl
