// A hash of 32-bit words.
#pragma once

#include <cstdint>

#include "core/kernel/base/platform.h"

namespace pl {

/// Adds a word to a hash. Every bit of either changes each bit of the result with a probability of about one half.   [Appleby 2011,
/// MurmurHash3, fmix32]
PL_HD inline std::uint32_t hash_word(std::uint32_t hash, std::uint32_t word) {
    hash = (hash ^ word) + 0x9E3779B9u;
    hash = (hash ^ (hash >> 16)) * 0x85EBCA6Bu;
    hash = (hash ^ (hash >> 13)) * 0xC2B2AE35u;
    return hash ^ (hash >> 16);
}

}  // namespace pl
