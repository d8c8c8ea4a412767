// Small vector and scalar functions on glm types.
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

/// Bound on the relative error of n chained roundings: n u / (1 - n u).   [Higham 2002, "Accuracy and Stability of
/// Numerical Algorithms", Lemma 3.1]
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

/// Without a branch: measurements of error ask for every pixel of four pictures.
PL_HD inline bool is_finite(const Vec3f& v) {
    const Vec3f zero = 0.0f * v;  // NaN where a component is not finite
    return zero.x + zero.y + zero.z == 0.0f;
}

/// Relative luminance of linear sRGB (Rec. 709 weights).
template <class Real>
PL_INLINE Real luminance_of(const Real& red, const Real& green, const Real& blue) {
    return 0.2126f * red + 0.7152f * green + 0.0722f * blue;
}
PL_HD inline float luminance(Vec3f rgb) { return luminance_of(rgb.x, rgb.y, rgb.z); }

/// Root mean square of the three channels of an RGB value that is not negative, from 4 % too small to 13 % too large: exact for
/// gray and for a single channel, and without squares, which would leave the range of float. Of all densities, one in
/// proportion to the root mean square of the contributions leaves the least sum of the variances of the channels.
/// `largest`: of the channels.
template <class Real>
PL_INLINE Real rms_of_channels(const Real& largest, const Real& sum) {
    constexpr float kOfSum = 0.21132487f;  // (3 - sqrt(3)) / 6
    constexpr float kOfLargest = 1.0f - 3.0f * kOfSum;
    return kOfLargest * largest + kOfSum * sum;
}
PL_HD inline float rms(Vec3f rgb) { return rms_of_channels(max_component(rgb), rgb.x + rgb.y + rgb.z); }

/// True if every channel is finite and not negative: the values that a film accepts.
PL_HD inline bool is_valid_radiance(Vec3f v) {
    return v.x >= 0.0f && v.y >= 0.0f && v.z >= 0.0f && v.x < kInfinity && v.y < kInfinity && v.z < kInfinity;
}

/// ln(x) for positive, normal x, error below 2e-7 (1 + |ln x|). Polynomial of the Cephes library.
PL_INLINE float log_of(float x) {
    constexpr float kRootOfHalf = 0.70710678118654752440f;
    const auto bits = std::bit_cast<std::uint32_t>(x);
    auto exponent = static_cast<float>(static_cast<int>(bits >> 23) - 126);
    float mantissa = std::bit_cast<float>((bits & 0x007fffffu) | 0x3f000000u);  // in [1/2, 1)
    if (mantissa < kRootOfHalf) {
        mantissa += mantissa;
        exponent -= 1.0f;
    }
    const float z = mantissa - 1.0f;
    const float high = ((7.0376836292e-2f * z - 1.1514610310e-1f) * z + 1.1676998740e-1f) * z - 1.2420140846e-1f;
    const float low = ((high * z + 1.4249322787e-1f) * z - 1.6668057665e-1f) * z + 2.0000714765e-1f;
    const float p = (low * z - 2.4999993993e-1f) * z + 3.3333331174e-1f;
    return (z + (p * z * z * z - 0.5f * z * z)) + exponent * 0.69314718055994530942f;
}
/// e^x for x in [-87, 87], relative error below 1e-6. Polynomial of the Cephes library. Like its relatives below without a branch and
/// without a function of a library, so that compilers make vectors of loops over it.
PL_INLINE float exp_of(float x) {
    const float power = x * 1.44269504088896341f + 0.5f;
    const auto truncated = static_cast<float>(static_cast<int>(power));
    const float n = truncated - (truncated > power ? 1.0f : 0.0f);
    const float z = (x - n * 0.693359375f) + n * 2.12194440e-4f;  // ln 2 in two parts
    const float high = ((1.9875691500e-4f * z + 1.3981999507e-3f) * z + 8.3334519073e-3f) * z + 4.1665795894e-2f;
    const float p = (high * z + 1.6666665459e-1f) * z + 5.0000001201e-1f;
    const float scale = std::bit_cast<float>(static_cast<std::uint32_t>(static_cast<int>(n) + 127) << 23);
    return (p * z * z + z + 1.0f) * scale;
}
/// From here on e^-x counts as 0.
inline constexpr float kMostDecay = 87.0f;
/// e^-x for x >= 0, infinite ones included, relative error below 1e-6.
PL_INLINE float decay_of(float x) {
    const float decay = exp_of(-min_of(kMostDecay, x));
    return x < kMostDecay ? decay : 0.0f;
}
/// 1 - e^-x for x >= 0, relative error below 1e-6.
PL_INLINE float complement_of_decay(float x) {
    constexpr float kSeries = 0.5f;
    const float y = min_of(x, kSeries);
    const float high = 1.0f / 120.0f - y * (1.0f / 720.0f - y * (1.0f / 5040.0f - y * (1.0f / 40320.0f)));
    const float series = y * (1.0f - y * (0.5f - y * (1.0f / 6.0f - y * (1.0f / 24.0f - y * high))));
    return x < kSeries ? series : 1.0f - decay_of(x);
}
/// -ln(1 - y) for y in [0, 1), relative error below 1e-6. Series of atanh where 1 - y has lost the digits of y.
PL_HD inline float log_of_complement(float y) {
    if (y >= 0.5f) return -log_of(1.0f - y);
    const float s = y / (2.0f - y);
    const float z = s * s;
    const float high = 1.0f / 7.0f + z * (1.0f / 9.0f + z * (1.0f / 11.0f + z * (1.0f / 13.0f)));
    return 2.0f * s * (1.0f + z * (1.0f / 3.0f + z * (1.0f / 5.0f + z * high)));
}

/// log2(x) for normal x > 0, exact for powers of two, error below 2e-7 (1 + |log2(x)|). Series of atanh; not the math
/// library's, which rounds differently on CPU and GPU.
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

}  // namespace pl
