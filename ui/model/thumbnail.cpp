#include "ui/model/thumbnail.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/hash.h"

namespace pl::ui {
namespace {

/// The PNG decoder does not check the bytes of the picture.
constexpr const char* kPixelsKey = "pixels";

std::string pixels_hash(const ByteImage& image) {
    Fnv1a hash;
    hash.add(std::string_view(reinterpret_cast<const char*>(image.rgb.data()), image.rgb.size()));
    return fmt::format("{:016x}", hash.value());
}

}  // namespace

std::optional<ByteImage> read_thumbnail(const std::filesystem::path& file) {
    try {
        ImageMetadata metadata;
        ByteImage image = read_png8(file, &metadata);
        const bool is_whole = image.width == kThumbnailWidth && image.height == kThumbnailHeight &&
                              text_of(metadata, kPixelsKey) == pixels_hash(image);
        return is_whole ? std::optional(std::move(image)) : std::nullopt;
    } catch (const Error&) {
        return std::nullopt;
    }
}

void write_thumbnail(const std::filesystem::path& file, const ByteImage& image) {
    write_png8(file, image, {{"Software", "pathlight " PL_VERSION}, {kPixelsKey, pixels_hash(image)}});
}

}  // namespace pl::ui
