#include "core/io/image.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <stb_image.h>

#include "core/base/memory.h"
#include "core/io/files.h"

namespace pl {

ImageKind image_kind(const std::filesystem::path& path) {
    const std::string suffix = suffix_of(path);
    if (suffix == ".exr") {
        return ImageKind::Exr;
    }
    if (suffix == ".pfm") {
        return ImageKind::Pfm;
    }
    if (suffix == ".png") {
        return ImageKind::Png;
    }
    throw Error(ErrorKind::Usage,
                fmt::format("{}: the suffix decides the kind of picture: expected .exr, .pfm or .png, got {}",
                            path.string(), suffix.empty() ? "none" : suffix));
}

void LinearSettings::note(const std::string& what) const {
    if (warnings != nullptr) warnings->push_back(fmt::format("{}: {}", path.string(), what));
}

LinearImage decode_linear(const std::string& bytes, const LinearSettings& settings) {
    const ImageKind kind = image_kind_of(bytes, settings.path);
    switch (kind) {
    case ImageKind::Exr: return decode_exr(bytes, settings);
    case ImageKind::Pfm: return decode_pfm(bytes, settings);
    case ImageKind::Hdr: return decode_hdr(bytes, settings);
    case ImageKind::Png:
    case ImageKind::Jpeg:
    case ImageKind::Tga:
    case ImageKind::Bmp: break;
    }
    fail_image(settings.path, fmt::format("expected a linear picture (exr, pfm or hdr), got an 8-bit one ({}): it is "
                                          "tone mapped and clipped",
                                          name_of(kind)));
}

LinearImage read_linear(const std::filesystem::path& path, ImageMetadata* metadata,
                        std::vector<std::string>* warnings) {
    return decode_linear(read_file(path), {.path = path, .metadata = metadata, .warnings = warnings});
}

LinearImage read_exr(const std::filesystem::path& path, ImageMetadata* metadata) {
    return decode_exr(read_file(path), {.path = path, .metadata = metadata});
}

std::string text_of(const ImageMetadata& metadata, const std::string& name) {
    for (const auto& [key, value] : metadata) {
        if (key == name) {
            return value;
        }
    }
    return "";
}

void require_complete(const std::filesystem::path& path, int width, int height, std::size_t size,
                      std::size_t per_pixel) {
    if (width <= 0 || height <= 0 ||
        size != static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * per_pixel) {
        throw Error(ErrorKind::Runtime, fmt::format("{}: cannot be written: a picture of {}x{} with {} values",
                                                    path.string(), width, height, size));
    }
}

void require_plausible(const std::filesystem::path& path, long long width, long long height) {
    constexpr long long kMostPixels = 1ll << 28;
    if (width <= 0 || height <= 0 || width > kMostPixels / height) {
        fail_image(path, fmt::format("a size of {}x{} is not supported", width, height));
    }
    constexpr std::uint64_t kPixelBytes = 24;  // as decoded, and as three floats
    require_memory(path.string(), static_cast<std::uint64_t>(width * height) * kPixelBytes, ErrorKind::Input);
}

std::string stb_failure() {
    const char* const reason = ::stbi_failure_reason();
    return reason == nullptr ? "unknown" : reason;
}

void fail_image(const std::filesystem::path& path, const std::string& why) {
    throw Error(ErrorKind::Input, path.string() + ": " + why);
}

// The kind of an image file by its first bytes.

namespace {

using std::string_view_literals::operator""sv;

/// Bytes that a file of this kind has at a place.
template <class Kind>
struct Signature {
    Kind kind;
    std::string_view bytes;
    std::size_t at = 0;
};

constexpr std::array<Signature<ImageKind>, 7> kReadable = {{
    {ImageKind::Exr, "\x76\x2f\x31\x01"},
    {ImageKind::Pfm, "PF"},
    {ImageKind::Pfm, "Pf"},
    {ImageKind::Png, "\x89PNG\r\n\x1a\n"},
    {ImageKind::Hdr, "#?"},
    {ImageKind::Jpeg, "\xff\xd8\xff"},
    {ImageKind::Bmp, "BM"},
}};

/// Kinds that are only named.
constexpr std::array<Signature<const char*>, 16> kOthers = {{
    {"a GIF image", "GIF8"},
    {"a WebP image", "WEBP", 8},
    {"an AVIF image", "ftypavif", 4},
    {"a HEIC image", "ftyphei", 4},
    {"a TIFF image", "II*\0"sv},
    {"a TIFF image", "MM\0*"sv},
    {"a Photoshop image", "8BPS"},
    {"a DDS image", "DDS "},
    {"a KTX image", "\xabKTX"},
    {"a JPEG 2000 image", "\0\0\0\x0cjP  "sv},
    {"a JPEG XL image", "\xff\x0a"},
    {"a PNM image", "P5"},
    {"a PNM image", "P6"},
    {"a page of the web", "<!DOCTYPE"},
    {"a page of the web", "<html"},
    {"a pointer of Git LFS, whose file was not fetched", "version https://git-lfs"},
}};

template <class Kind>
bool has(std::string_view file, const Signature<Kind>& signature) {
    return file.size() > signature.at && file.substr(signature.at).starts_with(signature.bytes);
}

template <class Signatures>
auto find_signature(std::string_view file, const Signatures& signatures) {
    return std::find_if(signatures.begin(), signatures.end(),
                        [&](const auto& signature) { return has(file, signature); });
}

/// TGA has no signature: its header has values that other files hardly have.   [Truevision TGA 2.0, section 2]
bool may_be_tga(std::string_view file) {
    constexpr std::size_t kHeader = 18;
    if (file.size() < kHeader) return false;
    const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(file[at]); };
    const auto is_one_of = [](int value, std::initializer_list<int> known) {
        return std::find(known.begin(), known.end(), value) != known.end();
    };
    const bool has_size = (byte(12) | byte(13)) != 0 && (byte(14) | byte(15)) != 0;
    if (!has_size) return false;
    if (byte(1) == 1) return is_one_of(byte(2), {1, 9}) && is_one_of(byte(16), {8, 16});
    return byte(1) == 0 && is_one_of(byte(2), {2, 3, 10, 11}) && is_one_of(byte(16), {8, 15, 16, 24, 32});
}

}  // namespace

ImageKind image_kind_of(std::string_view bytes, const std::filesystem::path& path) {
    if (const auto* known = find_signature(bytes, kReadable); known != kReadable.end()) return known->kind;
    const auto* other = find_signature(bytes, kOthers);
    if (other == kOthers.end() && may_be_tga(bytes)) return ImageKind::Tga;
    fail_image(path, fmt::format("expected an image (PNG, JPEG, TGA, BMP, Radiance HDR, EXR or PFM), got {}",
                                 bytes.empty()            ? "an empty file"
                                 : other != kOthers.end() ? other->kind
                                                          : "a file of another kind"));
}

}  // namespace pl
