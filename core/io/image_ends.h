// Images whose files end too early, before they are decoded: the decoder takes what is missing for black or gray.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace pl {

/// Whether a JPEG, TGA or BMP file (by its suffix, ".tga") lacks some of what an image of this size takes. False for other
/// kinds, whose decoders notice.   [ITU-T T.81, B.1; Truevision TGA 2.0, sections 2 to 4]
bool ends_early(const std::string& suffix, std::string_view file, std::size_t width, std::size_t height);

}  // namespace pl
