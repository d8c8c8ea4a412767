// Check of Radiance HDR files before decoding: stb_image reads missing bytes as zeros and loops forever on runs of
// length 0.
#pragma once

#include <cstddef>
#include <string_view>

namespace pl {

/// Whether the file has all scanlines of a picture of this size, with runs of at least one texel that end in their
/// line. Interprets the format as stb_image does: uncompressed texels if a line does not begin with the mark of a
/// compressed one.   [Ward 1991, "Real Pixels", Graphics Gems II]
bool has_whole_hdr_lines(std::string_view file, std::size_t width, std::size_t height);

}  // namespace pl
