#include "core/session/film_slots.h"

#include <fmt/format.h>

#include "core/base/memory.h"
#include "core/kernel/film/film_view.h"

namespace pl {

void require_film_memory(int width, int height, std::size_t held) {
    constexpr std::uint64_t kPictureBytes = 64;  // per pixel: as floats, as an EXR file, and in between
    const std::size_t pixels = film_pixels(width, height);
    const std::size_t more = pixels > held ? pixels - held : 0;
    require_memory(fmt::format("picture size {}x{}", width, height), pixels * kPictureBytes, ErrorKind::Usage,
                   more * sizeof(FilmPixel));
}

}  // namespace pl
