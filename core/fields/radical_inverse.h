// The van der Corput sequence in base 2.
#pragma once

#include <cstdint>

namespace pl {

/// Bits of `index` mirrored behind the binary point, in [0, 1).   [van der Corput 1935]
inline float radical_inverse(std::uint32_t index) {
    std::uint32_t mirrored = 0;
    for (int bit = 0; bit < 32; ++bit) mirrored |= ((index >> bit) & 1u) << (31 - bit);
    return static_cast<float>(mirrored >> 8) * 0x1p-24f;
}

}  // namespace pl
