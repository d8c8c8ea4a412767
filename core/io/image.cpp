#include "core/io/image.h"

#include <fmt/format.h>
#include <stb_image.h>

#include "core/base/memory.h"
#include "core/io/files.h"
#include "core/io/image_checks.h"

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

LinearImage read_pfm(const std::filesystem::path& path) { return decode_pfm(read_file(path), {.path = path}); }

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

}  // namespace pl
