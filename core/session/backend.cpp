#include "core/session/backend.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/usable_threads.h"

namespace pl {

int BackendInfo::free_threads() const { return threads > 0 ? threads : usable_threads(); }

std::size_t film_pixels(int width, int height) {
    constexpr std::int64_t kMostPixels = 0xffffffff;
    if (width <= 0 || height <= 0 || std::int64_t{width} * height > kMostPixels)
        throw Error(ErrorKind::Usage, fmt::format("picture size {}x{}: expected 1x1 to 2^32 pixels", width, height));
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

}  // namespace pl
