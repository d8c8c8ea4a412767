// Number traits. Arithmetic that runs on one number or on a vector of SIMD lanes is a template over N, which names
// the number types and the operations without an operator: One for scalars, the traits of cpu/lanes/lanes.h for
// vectors. Both use select() instead of branches and the same operations in the same order, so their bits agree.
#pragma once

#include <bit>
#include <cstring>
#include <limits>

#include "core/kernel/base/math.h"
#include "core/kernel/base/sobol.h"

namespace pl {

/// Blends per lane. `Mask` is bool, or a vector of lanes with all bits set or clear.
template <class Mask, class T>
PL_INLINE T select(Mask mask, T yes, T no) {
    return mask ? yes : no;
}

/// Four neighboring numbers; on a device one load.
struct alignas(16) FourFloats {
    float v[4];
};
/// Here and below `values` is aligned to 16 bytes.
PL_INLINE FourFloats load_four(const float* values) {
    FourFloats four;
    std::memcpy(&four, __builtin_assume_aligned(values, sizeof four), sizeof four);
    return four;
}
PL_INLINE void store_four(float* values, const FourFloats& four) {
    void* place = values;  // nvcc 13 does not take a pointer to float here
    std::memcpy(__builtin_assume_aligned(place, sizeof four), &four, sizeof four);
}

/// Scalars.
struct One {
    using Real = float;
    using Int = std::int32_t;
    using Uint = std::uint32_t;
    using Mask = bool;

    static PL_INLINE Real constant(float x) { return x; }
    static PL_INLINE Int constant(std::int32_t x) { return x; }
    static PL_INLINE Uint count(std::uint32_t x) { return x; }
    static PL_INLINE Real sqrt(Real x) { return std::sqrt(x); }
    static PL_INLINE Real magnitude(Real x) { return std::fabs(x); }
    static PL_INLINE Real copy_sign(Real size, Real sign) { return std::copysign(size, sign); }
    static PL_INLINE Real floor(Real x) { return std::floor(x); }
    static PL_INLINE Int truncate(Real x) { return static_cast<Int>(x); }
    static PL_INLINE Real to_real(Int i) { return static_cast<Real>(i); }
    static PL_INLINE Real count_to_real(Uint i) { return static_cast<Real>(i); }
    static PL_INLINE Int to_int(Uint i) { return static_cast<Int>(i); }
    static PL_INLINE Uint to_count(Int i) { return static_cast<Uint>(i); }
    static PL_INLINE Int bits_of(Real x) { return std::bit_cast<Int>(x); }
    static PL_INLINE Real from_bits(Int bits) { return std::bit_cast<Real>(bits); }
    static PL_INLINE Uint reversed(Uint bits) { return reversed_bits(bits); }
    static PL_INLINE bool any(Mask mask) { return mask; }
    static PL_INLINE Real load(const float* values, Int index) { return values[index]; }
    static PL_INLINE Int load(const std::int32_t* values, Int index) { return values[index]; }
    /// Number of the `count` ascending values from values[first] on that are not above x. If `count` is a multiple of 4, so is
    /// `first`, and `values` is aligned to 16 bytes.
    static PL_INLINE Int count_not_above(const float* values, Int first, int count, Real x) {
        Int index = 0;
        if (count % 4 == 0) {
            for (int i = 0; i < count; i += 4) {
                const FourFloats four = load_four(values + first + i);
                for (const float value : four.v) index += value <= x ? 1 : 0;
            }
            return index;
        }
        for (int i = 0; i < count; ++i) index += values[first + i] <= x ? 1 : 0;
        return index;
    }
};

template <class N>
struct Real2 {
    typename N::Real x, y;
};
template <class N>
struct Real3 {
    typename N::Real x, y, z;
};

PL_HD inline Real2<One> unpack(Vec2f v) { return {v.x, v.y}; }
PL_HD inline Real3<One> unpack(Vec3f v) { return {v.x, v.y, v.z}; }
PL_HD inline Vec2f pack(const Real2<One>& v) { return {v.x, v.y}; }
PL_HD inline Vec3f pack(const Real3<One>& v) { return {v.x, v.y, v.z}; }

template <class Mask, class N>
PL_INLINE Real2<N> select(Mask mask, const Real2<N>& yes, const Real2<N>& no) {
    return {select(mask, yes.x, no.x), select(mask, yes.y, no.y)};
}
template <class Mask, class N>
PL_INLINE Real3<N> select(Mask mask, const Real3<N>& yes, const Real3<N>& no) {
    return {select(mask, yes.x, no.x), select(mask, yes.y, no.y), select(mask, yes.z, no.z)};
}

template <class N>
PL_INLINE Real3<N> operator+(const Real3<N>& a, const Real3<N>& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class N>
PL_INLINE Real3<N> operator-(const Real3<N>& a, const Real3<N>& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class N>
PL_INLINE Real3<N> operator-(const Real3<N>& a) {
    return {-a.x, -a.y, -a.z};
}
template <class N>
PL_INLINE Real3<N> scaled(const Real3<N>& v, const typename N::Real& factor) {
    return {v.x * factor, v.y * factor, v.z * factor};
}
/// Component by component.
template <class N>
PL_INLINE Real3<N> product(const Real3<N>& a, const Real3<N>& b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}
template <class N>
PL_INLINE typename N::Real dot(const Real3<N>& a, const Real3<N>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class N>
PL_INLINE Real3<N> cross(const Real3<N>& a, const Real3<N>& b) {
    return {a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y};
}

/// At unit length: the bits of glm::normalize().
template <class N>
PL_INLINE Real3<N> normalized(const Real3<N>& v) {
    return scaled(v, 1.0f / N::sqrt(dot(v, v)));
}

/// A vector with the value of `v` in every lane.
template <class N>
PL_INLINE Real3<N> constant_vector(Vec3f v) {
    return {N::constant(v.x), N::constant(v.y), N::constant(v.z)};
}

/// Uniform in [0, 1): see to_unit_float().
template <class N>
PL_INLINE typename N::Real to_unit(const typename N::Uint& bits) {
    return N::to_real(N::to_int(bits >> 8)) * 0x1p-24f;
}

template <class N>
PL_INLINE typename N::Real clamp_real(typename N::Real x, float low, float high) {
    return select(x < low, N::constant(low), select(high < x, N::constant(high), x));
}
template <class N>
PL_INLINE typename N::Int clamp_int(typename N::Int i, std::int32_t low, std::int32_t high) {
    return select(i < low, N::constant(low), select(i > high, N::constant(high), i));
}

template <class N>
PL_INLINE typename N::Real min_real(const typename N::Real& x, float most) {
    return select(static_cast<typename N::Mask>(most < x), N::constant(most), x);
}
template <class N>
PL_INLINE typename N::Real max_real(const typename N::Real& x, float least) {
    return select(static_cast<typename N::Mask>(x < least), N::constant(least), x);
}

/// rms() of a Vec3f, for vectors: the same bits.
template <class N>
PL_INLINE typename N::Real rms(const Real3<N>& rgb) {
    const auto of_last = select(static_cast<typename N::Mask>(rgb.y < rgb.z), rgb.z, rgb.y);
    const auto largest = select(static_cast<typename N::Mask>(rgb.x < of_last), of_last, rgb.x);
    return rms_of_channels<typename N::Real>(largest, rgb.x + rgb.y + rgb.z);
}

/// The neighboring float towards +infinity for a `step` of 1, towards -infinity for -1; x itself for 0 and if x is
/// not finite. No branch depends on the step, whose sign is unpredictable; zeros and numbers that are not finite are rare.
template <class N>
PL_INLINE typename N::Real step_real(const typename N::Real& x, const typename N::Int& step) {
    const auto bits = N::bits_of(x);
    const auto sign = bits >> 31;  // 0 or -1
    const auto neighbor = N::from_bits(bits + ((step ^ sign) - sign));
    const auto is_special = static_cast<typename N::Mask>((x == 0.0f) | (N::magnitude(x) >= kInfinity) | (x != x));
    if (!N::any(is_special)) return neighbor;
    // The neighbor of 0, by its bits: a product with the least float would take an assist of the processor.
    const auto least = N::from_bits((step & std::numeric_limits<std::int32_t>::min()) | 1);
    const auto stepped = select(static_cast<typename N::Mask>(x == 0.0f), select(step == 0, x, least), neighbor);
    return select(static_cast<typename N::Mask>(N::magnitude(x) < kInfinity), stepped, x);
}
PL_HD inline float step_float(float x, std::int32_t step) { return step_real<One>(x, step); }
PL_HD inline float next_float_up(float x) { return step_float(x, 1); }
PL_HD inline float next_float_down(float x) { return step_float(x, -1); }

/// Largest integer not above x (floor), for |x| < 2^31.
template <class N>
PL_INLINE typename N::Int floor_of(typename N::Real x) {
    const typename N::Int truncated = N::truncate(x);
    return select(N::to_real(truncated) > x, truncated - 1, truncated);
}

// Sine, cosine and arctangent by the polynomials of the Cephes library: math libraries of CPU and GPU round
// differently.

/// sin(x) for |x| <= pi/4, error below 1e-7.
template <class N>
PL_INLINE typename N::Real sin_quarter(typename N::Real x) {
    const auto z = x * x;
    return x + x * z * (-1.6666654611e-1f + z * (8.3321608736e-3f + z * -1.9515295891e-4f));
}
/// cos(x) for |x| <= pi/4, error below 1e-7.
template <class N>
PL_INLINE typename N::Real cos_quarter(typename N::Real x) {
    const auto z = x * x;
    return 1.0f - 0.5f * z +
           z * z * (4.166664568298827e-2f + z * (-1.388731625493765e-3f + z * 2.443315711809948e-5f));
}
/// atan(x) for |x| <= 1, error below 2e-7, odd by construction.
template <class N>
PL_INLINE typename N::Real atan_unit(typename N::Real x) {
    const auto magnitude = N::magnitude(x);
    const typename N::Mask upper = magnitude > 0.4142135623730950f;  // tan(pi/8)
    const auto r = select(upper, (magnitude - 1.0f) / (magnitude + 1.0f), magnitude);
    const auto z = r * r;
    const auto p =
        (((8.05374449538e-2f * z - 1.38776856032e-1f) * z + 1.99777106478e-1f) * z - 3.33329491539e-1f) * z * r + r;
    const auto angle = select(upper, kPiOver4 + p, p);
    return select(x < 0.0f, -angle, angle);
}

}  // namespace pl
