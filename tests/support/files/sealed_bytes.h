// Files of fields and checkpoints after their bytes were changed, as a broken writer would write them.
#pragma once

#include <string>

#include "core/base/hash.h"

namespace pl::test {

inline constexpr std::size_t kPrefixBytes = 8 + 4 + 8;  // magic word, version, bytes
inline constexpr std::size_t kChecksumBytes = 8;

/// With the right number of bytes in front and the right checksum at the end; too few bytes are left as they are.
inline std::string sealed(std::string bytes) {
    if (bytes.size() < kPrefixBytes + kChecksumBytes) return bytes;
    const auto put = [&](std::size_t offset, std::uint64_t value) {
        for (std::size_t i = 0; i < 8; ++i) bytes[offset + i] = static_cast<char>(value >> (8 * i) & 0xffu);
    };
    put(kPrefixBytes - 8, bytes.size());
    Fnv1a hash;
    hash.add(std::string_view(bytes).substr(0, bytes.size() - kChecksumBytes));
    put(bytes.size() - kChecksumBytes, hash.value());
    return bytes;
}

}  // namespace pl::test
