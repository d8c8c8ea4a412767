// Small mathematics on glm types.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include <glm/glm.hpp>

#include "core/kernel/base/platform.h"

namespace pl {

using Vec2f = glm::vec2;
using Vec3f = glm::vec3;
using Vec4f = glm::vec4;
using Vec3d = glm::dvec3;

inline constexpr float kPi = 3.14159265358979323846f;
inline constexpr float kInvPi = 0.31830988618379067154f;
inline constexpr float kPiOver4 = 0.78539816339744830961f;
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();
inline constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// Unit roundoff of float: half the gap between 1 and the next float.
inline constexpr float kRoundoff = 0x1p-24f;

/// Bound on the relative error of n chained roundings: n u / (1 - n u).   [Higham 2002, Lemma 3.1]
PL_HD constexpr float gamma_bound(int n) {
    return (static_cast<float>(n) * kRoundoff) / (1.0f - static_cast<float>(n) * kRoundoff);
}

template <class T>
PL_HD constexpr T min_of(T a, T b) {
    return b < a ? b : a;
}
template <class T>
PL_HD constexpr T max_of(T a, T b) {
    return a < b ? b : a;
}
template <class T>
PL_HD constexpr T clamp_to(T x, T low, T high) {
    return x < low ? low : (high < x ? high : x);
}
PL_HD inline float max_component(Vec3f v) { return max_of(v.x, max_of(v.y, v.z)); }
PL_HD inline bool is_black(Vec3f v) { return v.x == 0.0f && v.y == 0.0f && v.z == 0.0f; }
PL_HD inline float square(float x) { return x * x; }
PL_HD inline float safe_sqrt(float x) { return std::sqrt(max_of(x, 0.0f)); }
PL_HD inline Vec3f absolute(Vec3f v) { return {std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}; }

/// Relative luminance of linear sRGB (Rec. 709 weights).
PL_HD inline float luminance(Vec3f rgb) { return 0.2126f * rgb.x + 0.7152f * rgb.y + 0.0722f * rgb.z; }

/// True for values a film may keep: finite and not negative in every channel.
PL_HD inline bool is_valid_radiance(Vec3f v) {
    return v.x >= 0.0f && v.y >= 0.0f && v.z >= 0.0f && v.x < kInfinity && v.y < kInfinity && v.z < kInfinity;
}

/// log2(x) for normal x > 0, exact for powers of two, error below 2e-7 (1 + |log2(x)|). By the series of atanh; own
/// because the library's differs between CPU and GPU.
PL_HD inline float log2_normal(float x) {
    constexpr float kTwoOverLn2 = 2.88539008f;
    const auto bits = std::bit_cast<std::uint32_t>(x);
    float exponent = static_cast<float>(static_cast<std::int32_t>(bits >> 23) - 127);
    float mantissa = std::bit_cast<float>((bits & 0x007fffffu) | 0x3f800000u);
    if (mantissa > 1.41421356f) {
        mantissa *= 0.5f;
        exponent += 1.0f;
    }
    const float s = (mantissa - 1.0f) / (mantissa + 1.0f);
    const float z = s * s;
    const float series = 1.0f + z * (1.0f / 3.0f + z * (1.0f / 5.0f + z * (1.0f / 7.0f + z * (1.0f / 9.0f))));
    return exponent + kTwoOverLn2 * (s * series);
}

/// The neighbouring float towards +infinity; +infinity stays.
PL_HD inline float next_float_up(float x) {
    if (x == kInfinity) return x;
    if (x == 0.0f) return std::bit_cast<float>(std::uint32_t{1});
    const auto bits = std::bit_cast<std::uint32_t>(x);
    return std::bit_cast<float>(x > 0.0f ? bits + 1u : bits - 1u);
}
/// The neighbouring float towards -infinity; -infinity stays.
PL_HD inline float next_float_down(float x) { return -next_float_up(-x); }

}  // namespace pl
