// Picture files: EXR, PFM and HDR hold linear values, PNG holds 8-bit display values.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "core/base/choice.h"

namespace pl {

// Checks shared by all picture formats.

/// Throws Error(Runtime) unless width and height are positive and `size` = width x height x `per_pixel`.
void require_complete(const std::filesystem::path& path, int width, int height, std::size_t size,
                      std::size_t per_pixel);

/// Throws Error(Input) unless width and height are positive, with at most 2^28 pixels; MemoryError if these do not fit the memory.
void require_plausible(const std::filesystem::path& path, long long width, long long height);

/// The reason of the last failure of stb_image, "unknown" where it gives none.
std::string stb_failure();

[[noreturn]] void fail_image(const std::filesystem::path& path, const std::string& why);

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

enum class ImageKind { Exr, Pfm, Png, Hdr, Jpeg, Tga, Bmp };

/// The kinds that the program writes.
template <>
inline constexpr auto kChoices<ImageKind> = std::to_array<ChoiceInfo<ImageKind>>({
    {ImageKind::Png, "png", "PNG", "tone mapped"},
    {ImageKind::Exr, "exr", "EXR", "linear"},
    {ImageKind::Pfm, "pfm", "PFM", "linear"},
});

/// "exr", "pfm", "png" and so on: also the extension.
constexpr std::string_view name_of(ImageKind kind) {
    switch (kind) {
    case ImageKind::Exr:
    case ImageKind::Pfm:
    case ImageKind::Png: break;
    case ImageKind::Hdr: return "hdr";
    case ImageKind::Jpeg: return "jpg";
    case ImageKind::Tga: return "tga";
    case ImageKind::Bmp: return "bmp";
    }
    return name_of<ImageKind>(kind);
}

/// Whether files of this kind hold linear values.
constexpr bool is_linear(ImageKind kind) {
    return kind == ImageKind::Exr || kind == ImageKind::Pfm || kind == ImageKind::Hdr;
}

/// Kind of a picture that is written, by its file name extension, case-insensitive: EXR, PFM or PNG. Throws
/// Error(Usage) that lists these.
ImageKind image_kind(const std::filesystem::path& path);

/// Kind of an image file by its bytes, whatever its name. `path` is for messages. Throws Error(Input) that says what
/// the file is instead, if that is known.
ImageKind image_kind_of(std::string_view bytes, const std::filesystem::path& path);

// Writers are atomic (write_file_atomic). They throw Error(Runtime) with path and reason, also if the number of
// pixels is 0 or does not match width and height.

enum class ExrNumbers {
    Float,  ///< 32 bits
    Half,   ///< 16 bits, 11 of them significant; clamped to 65504
};

/// EXR, losslessly compressed. Metadata become attributes of type string; names are cut to 255 bytes.
void write_exr(const std::filesystem::path& path, const LinearImage& image, const ImageMetadata& metadata = {},
               ExrNumbers numbers = ExrNumbers::Float);
/// The bytes of the file. Throws Error(Runtime) if the encoder fails.
std::string encode_exr(const LinearImage& image, const ImageMetadata& metadata = {},
                       ExrNumbers numbers = ExrNumbers::Float);

/// PFM with little-endian floats; no metadata.
void write_pfm(const std::filesystem::path& path, const LinearImage& image);
/// The bytes of the file.
std::string encode_pfm(const LinearImage& image);

/// PNG. Metadata become tEXt chunks; names are cut to 79 bytes, the limit of PNG.
void write_png8(const std::filesystem::path& path, const ByteImage& image, const ImageMetadata& metadata = {});
/// The bytes of the file. Throws Error(Runtime) if the encoder fails.
std::string encode_png8(const ByteImage& image, const ImageMetadata& metadata = {});

/// The value of the first entry with this name; empty if there is none.
std::string text_of(const ImageMetadata& metadata, const std::string& name);

// Readers throw Error(Input) if the file is missing, of another kind, or truncated. `metadata` receives the stored
// names and values.

/// How the bytes of a linear picture are read.
struct LinearSettings {
    std::filesystem::path path{};  ///< for messages
    /// Throws Error(Input) for a size that is not wanted, before pixels are read.
    void (*require_size)(const std::filesystem::path& path, long long width, long long height) = require_plausible;
    ImageMetadata* metadata = nullptr;
    std::vector<std::string>* warnings = nullptr;  ///< receives what the reader chose or left out
    std::vector<float>* alpha = nullptr;           ///< receives the alpha of each pixel, if the file has alpha

    /// A warning about the file.
    void note(const std::string& what) const;
};

/// EXR, PFM or Radiance HDR, by the bytes. 8-bit pictures are refused: tone-mapped and clipped values cannot be
/// measured.
LinearImage decode_linear(const std::string& bytes, const LinearSettings& settings);

/// The layer of an EXR file that choose_exr_layer() names, without subsampled channels except luminance and chroma.
/// The image is the data window, of colors as they are stored, times alpha.   [OpenEXR, "Technical Introduction"]
LinearImage decode_exr(const std::string& bytes, const LinearSettings& settings);

/// PFM of colors ("PF") or gray ("Pf"), of either byte order.
LinearImage decode_pfm(std::string_view bytes, const LinearSettings& settings);

/// Radiance HDR with either kind of run lengths and in any orientation.   [Ward, "The RADIANCE Picture File Format"]
LinearImage decode_hdr(std::string_view bytes, const LinearSettings& settings);

/// decode_linear() of a file.
LinearImage read_linear(const std::filesystem::path& path, ImageMetadata* metadata = nullptr,
                        std::vector<std::string>* warnings = nullptr);

/// decode_exr() of a file of this program.
LinearImage read_exr(const std::filesystem::path& path, ImageMetadata* metadata = nullptr);

ByteImage read_png8(const std::filesystem::path& path, ImageMetadata* metadata = nullptr);

}  // namespace pl
