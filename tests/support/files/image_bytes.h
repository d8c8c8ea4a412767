// Small image files, byte by byte.
#pragma once

#include <cstdint>
#include <string>

namespace pl::test {

inline std::string four_bytes(std::uint32_t value, bool big_endian) {
    std::string bytes;
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>(value >> 8 * (big_endian ? 3 - i : i) & 0xffu);
    return bytes;
}

/// Uncompressed, 32 bits per texel: blue, green, red, alpha; from the top row down.
inline std::string tga(int width, int height, const std::string& texels) {
    std::string bytes(18, '\0');
    bytes[2] = 2;
    bytes[12] = static_cast<char>(width);
    bytes[14] = static_cast<char>(height);
    bytes[16] = 32;
    bytes[17] = 0x28;
    return bytes + texels;
}

/// Radiance picture, uncompressed: mantissas and the common exponent.
inline std::string hdr(int width, int height, const std::string& rgbe) {
    return "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(height) + " +X " + std::to_string(width) +
           "\n" + rgbe;
}

}  // namespace pl::test
