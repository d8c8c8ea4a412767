#include "core/session/backend.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"

namespace pl {

int BackendInfo::free_threads() const { return threads > 0 ? threads : usable_threads(); }

std::string device_text(const BackendInfo& info) {
    std::string text = info.device;
    if (info.threads > 0) text += fmt::format(", {} {}", info.threads, info.threads == 1 ? "thread" : "threads");
    if (info.ranks > 1) text += fmt::format(", {} ranks", info.ranks);
    return text;
}

std::size_t film_pixels(int width, int height) {
    constexpr std::int64_t kMostPixels = 0xffffffff;
    if (width <= 0 || height <= 0 || std::int64_t{width} * height > kMostPixels)
        throw Error(ErrorKind::Usage, fmt::format("picture size {}x{}: expected 1x1 to 2^32 pixels", width, height));
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

void require_film_memory(int width, int height, std::size_t held) {
    constexpr std::uint64_t kPictureBytes = 64;  // per pixel: as floats, as an EXR file, and in between
    const std::size_t pixels = film_pixels(width, height);
    const std::size_t more = pixels > held ? pixels - held : 0;
    require_memory(fmt::format("picture size {}x{}", width, height), pixels * kPictureBytes, ErrorKind::Usage,
                   more * sizeof(FilmPixel));
}

}  // namespace pl
