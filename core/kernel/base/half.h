// IEEE 754 binary16 in software, for textures in memory and picture files: 11 significant bits.
#pragma once

#include <bit>
#include <cstdint>

#include "core/kernel/base/platform.h"

namespace pl {

inline constexpr float kLargestHalf = 65504.0f;

/// Nearest half float, ties to even. Magnitudes above kLargestHalf, infinity too, become kLargestHalf; NaN stays NaN.
/// [IEEE 754-2008, 3.6 and 4.3.1]
PL_HD inline std::uint16_t to_half(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const std::uint32_t sign = bits >> 16 & 0x8000u;
    const std::uint32_t size = bits & 0x7fffffffu;
    if (size > 0x7f800000u) return static_cast<std::uint16_t>(sign | 0x7e00u);
    if (size >= std::bit_cast<std::uint32_t>(kLargestHalf)) return static_cast<std::uint16_t>(sign | 0x7bffu);
    constexpr std::uint32_t kSmallestNormal = 0x38800000u;  // 2^-14
    if (size < kSmallestNormal) {
        // Floats in [1/2, 1) have the spacing of subnormal halves, 2^-24, so the addition rounds to it.
        const float shifted = std::bit_cast<float>(size) + 0.5f;
        return static_cast<std::uint16_t>(sign | (std::bit_cast<std::uint32_t>(shifted) - 0x3f000000u));
    }
    const std::uint32_t rounded = size + 0xfffu + (size >> 13 & 1u);
    return static_cast<std::uint16_t>(sign | ((rounded - 0x38000000u) >> 13));
}

/// The value of a half float, exactly.
PL_HD inline float from_half(std::uint16_t half) {
    const std::uint32_t sign = (half & 0x8000u) << 16;
    const std::uint32_t size = half & 0x7fffu;
    if (size >= 0x7c00u) return std::bit_cast<float>(sign | 0x7f800000u | (size & 0x3ffu) << 13);
    if (size >= 0x400u) return std::bit_cast<float>(sign | ((size << 13) + 0x38000000u));
    const float subnormal = static_cast<float>(size) * 0x1p-24f;
    return std::bit_cast<float>(sign | std::bit_cast<std::uint32_t>(subnormal));
}

}  // namespace pl
