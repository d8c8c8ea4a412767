#include "core/io/image_ends.h"

#include <algorithm>

namespace pl {
namespace {

/// Little-endian number of `size` bytes; bytes beyond the end are 0.
std::size_t number_at(std::string_view file, std::size_t at, int size) {
    std::size_t value = 0;
    for (int i = size; i-- > 0;) {
        const std::size_t place = at + static_cast<std::size_t>(i);
        value = value << 8 | (place < file.size() ? static_cast<unsigned char>(file[place]) : 0u);
    }
    return value;
}

/// The end marker must follow the start of the last scan: an earlier one belongs to a thumbnail.
bool jpeg_ends_early(std::string_view file) {
    const std::size_t scan = file.rfind("\xff\xda");
    return scan == std::string_view::npos || file.find("\xff\xd9", scan) == std::string_view::npos;
}

/// Walks the packets of a run-length encoded image: a header byte, then one texel or up to 128.
bool tga_runs_end_early(std::string_view file, std::size_t at, std::size_t texels, std::size_t texel_bytes) {
    constexpr std::size_t kRepeats = 128;
    while (texels > 0) {
        if (at >= file.size()) return true;
        const std::size_t mark = number_at(file, at, 1);
        const std::size_t length = mark % kRepeats + 1;
        at += 1 + (mark >= kRepeats ? 1 : length) * texel_bytes;
        texels -= std::min(texels, length);
    }
    return at > file.size();
}

bool tga_ends_early(std::string_view file, std::size_t texels) {
    constexpr std::size_t kHeader = 18;
    constexpr std::size_t kCoded = 8;
    const std::size_t palette = number_at(file, 5, 2) * ((number_at(file, 7, 1) + 7) / 8);
    const std::size_t first = kHeader + number_at(file, 0, 1) + (number_at(file, 1, 1) != 0 ? palette : 0);
    const std::size_t texel_bytes = (number_at(file, 16, 1) + 7) / 8;
    if ((number_at(file, 2, 1) & kCoded) != 0) return tga_runs_end_early(file, first, texels, texel_bytes);
    return file.size() < first + texels * texel_bytes;
}

/// Rows are padded to four bytes; the padding of the last one may be missing.
bool bmp_ends_early(std::string_view file, std::size_t width, std::size_t height) {
    constexpr std::size_t kOldHeader = 12;
    const std::size_t first = number_at(file, 10, 4);
    const std::size_t texel_bits = number_at(file, number_at(file, 14, 4) == kOldHeader ? 24 : 28, 2);
    const std::size_t row = (width * texel_bits + 31) / 32 * 4;
    return file.size() < first + row * (height - 1) + (width * texel_bits + 7) / 8;
}

}  // namespace

bool ends_early(ImageKind kind, std::string_view file, std::size_t width, std::size_t height) {
    if (kind == ImageKind::Jpeg) return jpeg_ends_early(file);
    if (kind == ImageKind::Tga) return tga_ends_early(file, width * height);
    if (kind == ImageKind::Bmp) return bmp_ends_early(file, width, height);
    return false;
}

}  // namespace pl
