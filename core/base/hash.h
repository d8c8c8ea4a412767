// Fnv1a: a 64-bit hash of values, the same on every machine. Not cryptographic.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace pl {

/// [Fowler, Noll, Vo, "FNV-1a", 64 bit]
class Fnv1a {
public:
    /// The eight bytes, the lowest first. Those above the highest that is not 0 only multiply, which they do at once: large scenes are
    /// mostly small numbers.
    void add(std::uint64_t value) {
        int zeros = 8;
        for (; value != 0; value >>= 8, --zeros) add_byte(static_cast<std::uint8_t>(value));
        state_ *= kPowers[zeros];
    }
    /// Adds the bits of the number; -0 counts as 0, because they give the same picture.
    void add(float value) { add(std::uint64_t{std::bit_cast<std::uint32_t>(value == 0.0f ? 0.0f : value)}); }
    void add(std::string_view text) {
        add(std::uint64_t{text.size()});
        for (const char c : text) add_byte(static_cast<std::uint8_t>(c));
    }

    std::uint64_t value() const { return state_; }

private:
    static constexpr std::uint64_t kPrime = 0x100000001b3u;
    static constexpr std::array<std::uint64_t, 9> kPowers = [] {
        std::array<std::uint64_t, 9> powers{1};
        for (std::size_t i = 1; i < powers.size(); ++i) powers[i] = powers[i - 1] * kPrime;
        return powers;
    }();

    void add_byte(std::uint8_t byte) { state_ = (state_ ^ byte) * kPrime; }

    std::uint64_t state_ = 0xcbf29ce484222325u;
};

}  // namespace pl
