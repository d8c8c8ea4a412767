// Detection of truncated image files before decoding: the decoder reads missing bytes as black or gray.
#pragma once

#include <cstddef>
#include <string_view>

#include "core/io/image.h"

namespace pl {

/// Whether a JPEG, TGA or BMP file is too short for an image of this size. False for
/// other kinds, whose decoders detect it.   [ITU-T T.81, B.1; Truevision TGA 2.0, sections 2 to 4]
bool ends_early(ImageKind kind, std::string_view file, std::size_t width, std::size_t height);

}  // namespace pl
