// Fnv1a: a 64-bit hash of values, the same on every machine. Not cryptographic.
#pragma once

#include <bit>
#include <cstdint>
#include <string_view>

namespace pl {

/// [Fowler, Noll, Vo, "FNV-1a", 64 bit]
class Fnv1a {
public:
    void add(std::uint64_t value) {
        for (int byte = 0; byte < 8; ++byte) add_byte(static_cast<std::uint8_t>(value >> (8 * byte)));
    }
    /// Adds the bits of the number; -0 counts as 0, because they give the same picture.
    void add(float value) { add(std::uint64_t{std::bit_cast<std::uint32_t>(value == 0.0f ? 0.0f : value)}); }
    void add(std::string_view text) {
        add(std::uint64_t{text.size()});
        for (const char c : text) add_byte(static_cast<std::uint8_t>(c));
    }

    std::uint64_t value() const { return state_; }

private:
    void add_byte(std::uint8_t byte) { state_ = (state_ ^ byte) * 0x100000001b3u; }

    std::uint64_t state_ = 0xcbf29ce484222325u;
};

}  // namespace pl
