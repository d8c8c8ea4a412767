// Radiance pictures, before they are decoded: the decoder takes what is missing for zeros, among them runs of no length,
// of which it never gets to the end.
#pragma once

#include <cstddef>
#include <string_view>

namespace pl {

/// Whether all scanlines of a picture of this size are there, every run of at least one texel and none beyond its line.
/// Follows the format as stb_image reads it: flat texels where a line does not begin as a coded one.
/// [Ward 1991, "Real Pixels", Graphics Gems II]
bool has_whole_hdr_lines(std::string_view file, std::size_t width, std::size_t height);

}  // namespace pl
