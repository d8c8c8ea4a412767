#include "core/io/image.h"

#include <fmt/format.h>

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

LinearImage read_linear(const std::filesystem::path& path, ImageMetadata* metadata) {
    const std::string suffix = suffix_of(path);
    if (suffix == ".pfm") {
        return read_pfm(path);
    }
    if (suffix == ".exr") {
        return read_exr(path, metadata);
    }
    fail_image(path, fmt::format("expected a linear picture, .exr or .pfm, got {}",
                                 suffix == ".png" ? "an 8-bit one: it is tone mapped and clipped"
                                 : suffix.empty() ? "a file without suffix"
                                                  : suffix));
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

void fail_image(const std::filesystem::path& path, const std::string& why) {
    throw Error(ErrorKind::Input, path.string() + ": " + why);
}

}  // namespace pl
