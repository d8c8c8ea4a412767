#include "core/io/frame_file.h"

#include <fmt/format.h>

namespace pl {

std::filesystem::path frame_file(const std::filesystem::path& folder, int index, ImageKind kind) {
    return folder / fmt::format("frame_{:04}.{}", index + 1, name_of(kind));
}

}  // namespace pl
