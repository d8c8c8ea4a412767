// SIMD vectors of floats and integers (vector extensions of gcc and clang): operators apply to all lanes, comparisons
// return lanes with all bits set or clear. Files that include this header are compiled once per instruction set (see
// cpu/CMakeLists.txt), with its vector width. They must share no inline function with the rest of the program, since
// the linker could keep a copy with instructions the machine lacks: hence the unnamed namespace.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#ifdef __SSE2__
#include <immintrin.h>
#endif

#include "core/kernel/geometry/triangle.h"
#include "cpu/base/ray_batch.h"

namespace pl {
namespace {

#if defined(__AVX512F__)
constexpr std::uint32_t kLaneWidth = 16;
#elif defined(__AVX2__)
constexpr std::uint32_t kLaneWidth = 8;
#else
constexpr std::uint32_t kLaneWidth = 4;
#endif
static_assert(kGroupSize % kLaneWidth == 0);

using LaneFloat = float __attribute__((vector_size(4 * kLaneWidth)));
using LaneInt = std::int32_t __attribute__((vector_size(4 * kLaneWidth)));
using LaneUint = std::uint32_t __attribute__((vector_size(4 * kLaneWidth)));

/// Vectors for the tests of one ray, with the children of a node or the triangles of a leaf: up to eight of them.
constexpr std::uint32_t kTestWidth = kLaneWidth < 8 ? kLaneWidth : 8;
using TestFloat = float __attribute__((vector_size(4 * kTestWidth)));
using TestInt = std::int32_t __attribute__((vector_size(4 * kTestWidth)));
using TestUint = std::uint32_t __attribute__((vector_size(4 * kTestWidth)));

/// The result of comparing vectors.
template <class Real>
using MaskOf = decltype(Real{} < Real{});

template <class Lanes, class T>
PL_INLINE Lanes load_lanes(const T* row) {
    Lanes lanes;
    std::memcpy(&lanes, row, sizeof(lanes));
    return lanes;
}
template <class Lanes, class T>
PL_INLINE void store_lanes(const Lanes& lanes, T* row) {
    std::memcpy(row, &lanes, sizeof(lanes));
}

template <class Vector, class T>
PL_INLINE Vector broadcast_to(T x) {
    return x - Vector{};
}
PL_INLINE LaneFloat broadcast(float x) { return broadcast_to<LaneFloat>(x); }
PL_INLINE LaneUint broadcast(std::uint32_t x) { return broadcast_to<LaneUint>(x); }

template <class Vector>
PL_INLINE Vector larger(Vector a, Vector b) {
    return a > b ? a : b;
}
template <class Vector>
PL_INLINE Vector smaller(Vector a, Vector b) {
    return a < b ? a : b;
}

/// |x|, bit-identical to std::fabs.
PL_INLINE LaneFloat magnitude(LaneFloat x) {
    return std::bit_cast<LaneFloat>(std::bit_cast<LaneUint>(x) & 0x7fffffffu);
}

/// Vector of half as many lanes, of 64 bits each.
using LaneWide = std::uint64_t __attribute__((vector_size(4 * kLaneWidth)));

/// 64-bit products of the lower half of each lane and one factor.
PL_INLINE LaneWide multiply_low_halves(LaneWide lanes, std::uint32_t factor) {
#if defined(__AVX512F__)
    // Masked form: gcc 12 warns of an uninitialized value inside the unmasked one.
    return std::bit_cast<LaneWide>(_mm512_maskz_mul_epu32(0xff, std::bit_cast<__m512i>(lanes),
                                                          _mm512_set1_epi64(static_cast<long long>(factor))));
#elif defined(__AVX2__)
    return std::bit_cast<LaneWide>(
        _mm256_mul_epu32(std::bit_cast<__m256i>(lanes), _mm256_set1_epi64x(static_cast<long long>(factor))));
#elif defined(__SSE2__)
    return std::bit_cast<LaneWide>(
        _mm_mul_epu32(std::bit_cast<__m128i>(lanes), _mm_set1_epi64x(static_cast<long long>(factor))));
#else
    return (lanes & 0xffffffffu) * factor;
#endif
}

#if defined(__AVX512F__)
using ByteLanes = __m512i;
PL_INLINE ByteLanes shuffle_bytes(ByteLanes bytes, ByteLanes order) {
    return _mm512_maskz_shuffle_epi8(~0ull, bytes, order);  // masked as above
}
#elif defined(__AVX2__)
using ByteLanes = __m256i;
PL_INLINE ByteLanes shuffle_bytes(ByteLanes bytes, ByteLanes order) { return _mm256_shuffle_epi8(bytes, order); }
#endif
#if defined(__AVX2__)
/// The bits of each lane in reverse order: the bits of each half byte by a table, and the bytes by a shuffle.
PL_INLINE LaneUint reversed_lanes(const LaneUint& lanes) {
    constexpr std::uint32_t kHalfBytes = 0x0f0f0f0fu;
    // Bytes 0 to 15, repeated: the reverse of their number in the upper and in the lower half of a byte; 3, 2, 1, 0, 7, 6, 5, 4, ...
    const auto repeated = [](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        LaneUint words;
        for (std::uint32_t i = 0; i < kLaneWidth; i += 4) {
            words[i] = a;
            words[i + 1] = b;
            words[i + 2] = c;
            words[i + 3] = d;
        }
        return words;
    };
    const LaneUint upper = repeated(0xc0408000u, 0xe060a020u, 0xd0509010u, 0xf070b030u);
    const LaneUint order = repeated(0x00010203u, 0x04050607u, 0x08090a0bu, 0x0c0d0e0fu);
    const auto look_up = [](const LaneUint& table, const LaneUint& half_bytes) {
        return std::bit_cast<LaneUint>(
            shuffle_bytes(std::bit_cast<ByteLanes>(table), std::bit_cast<ByteLanes>(half_bytes)));
    };
    const LaneUint bytes = look_up(upper, lanes & kHalfBytes) | look_up(upper >> 4, (lanes >> 4) & kHalfBytes);
    return std::bit_cast<LaneUint>(shuffle_bytes(std::bit_cast<ByteLanes>(bytes), std::bit_cast<ByteLanes>(order)));
}
#endif

/// Packs a mask into one bit per lane, lane 0 in the lowest bit.
PL_INLINE std::uint32_t mask_bits(LaneInt mask) {
#if defined(__AVX512F__)
    const auto lanes = std::bit_cast<__m512i>(mask);
    return _mm512_test_epi32_mask(lanes, lanes);
#elif defined(__AVX2__)
    return static_cast<std::uint32_t>(_mm256_movemask_ps(std::bit_cast<__m256>(mask)));
#elif defined(__SSE2__)
    return static_cast<std::uint32_t>(_mm_movemask_ps(std::bit_cast<__m128>(mask)));
#else
    std::uint32_t bits = 0;
    for (std::uint32_t lane = 0; lane < kLaneWidth; ++lane) bits |= (mask[lane] != 0 ? 1u : 0u) << lane;
    return bits;
#endif
}
#if defined(__AVX512F__)
PL_INLINE std::uint32_t mask_bits(TestInt mask) {
    return static_cast<std::uint32_t>(_mm256_movemask_ps(std::bit_cast<__m256>(mask)));
}
#endif

/// Four neighboring words, and shuffles of vectors of such quarters.
using FourWords = std::int32_t __attribute__((vector_size(16)));
#if defined(__AVX512F__)
/// at(i), at(4 + i), ... one after the other.
PL_INLINE LaneInt join_quarters(const auto& at, std::uint32_t i) {
    const auto half = [&](std::uint32_t first) {
        return __builtin_shufflevector(at(first), at(first + 4), 0, 1, 2, 3, 4, 5, 6, 7);
    };
    return __builtin_shufflevector(half(i), half(i + 8), 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
}
/// In each quarter: the words i and i + 1 of `a`, then of `b`.
template <int i>
PL_INLINE LaneInt join_pairs(const LaneInt& a, const LaneInt& b) {
    return __builtin_shufflevector(a, b, i, i + 1, i + 16, i + 17, i + 4, i + 5, i + 20, i + 21, i + 8, i + 9, i + 24,
                                   i + 25, i + 12, i + 13, i + 28, i + 29);
}
/// In each quarter: the words i and i + 1 of `a` and `b` in turn.
template <int i>
PL_INLINE LaneInt interleave_words(const LaneInt& a, const LaneInt& b) {
    return __builtin_shufflevector(a, b, i, i + 16, i + 1, i + 17, i + 4, i + 20, i + 5, i + 21, i + 8, i + 24, i + 9,
                                   i + 25, i + 12, i + 28, i + 13, i + 29);
}
#elif defined(__AVX2__)
PL_INLINE LaneInt join_quarters(const auto& at, std::uint32_t i) {
    return __builtin_shufflevector(at(i), at(i + 4), 0, 1, 2, 3, 4, 5, 6, 7);
}
template <int i>
PL_INLINE LaneInt join_pairs(const LaneInt& a, const LaneInt& b) {
    return __builtin_shufflevector(a, b, i, i + 1, i + 8, i + 9, i + 4, i + 5, i + 12, i + 13);
}
template <int i>
PL_INLINE LaneInt interleave_words(const LaneInt& a, const LaneInt& b) {
    return __builtin_shufflevector(a, b, i, i + 8, i + 1, i + 9, i + 4, i + 12, i + 5, i + 13);
}
#else
PL_INLINE LaneInt join_quarters(const auto& at, std::uint32_t i) { return at(i); }
template <int i>
PL_INLINE LaneInt join_pairs(const LaneInt& a, const LaneInt& b) {
    return __builtin_shufflevector(a, b, i, i + 1, i + 4, i + 5);
}
template <int i>
PL_INLINE LaneInt interleave_words(const LaneInt& a, const LaneInt& b) {
    return __builtin_shufflevector(a, b, i, i + 4, i + 1, i + 5);
}
#endif

/// The vector counterpart of One, for arithmetic templated on the number of lanes; see core/kernel/base/numbers.h.
struct Lanes {
    using Real = LaneFloat;
    using Int = LaneInt;
    using Uint = LaneUint;
    using Mask = LaneInt;

    static PL_INLINE Real constant(float x) { return broadcast(x); }
    static PL_INLINE Int constant(std::int32_t x) { return x - Int{}; }
    static PL_INLINE Uint count(std::uint32_t x) { return broadcast(x); }
    static PL_INLINE Real sqrt(const Real& x) {
#if defined(__AVX512F__)
        return std::bit_cast<Real>(_mm512_maskz_sqrt_ps(0xffff, std::bit_cast<__m512>(x)));
#elif defined(__AVX2__)
        return std::bit_cast<Real>(_mm256_sqrt_ps(std::bit_cast<__m256>(x)));
#elif defined(__SSE2__)
        return std::bit_cast<Real>(_mm_sqrt_ps(std::bit_cast<__m128>(x)));
#else
        Real root;
        for (std::uint32_t lane = 0; lane < kLaneWidth; ++lane) root[lane] = __builtin_sqrtf(x[lane]);
        return root;
#endif
    }
    static PL_INLINE Uint reversed(const Uint& bits) {
#if defined(__AVX2__)
        return reversed_lanes(bits);
#else
        return reversed_bits(bits);
#endif
    }
    static PL_INLINE Real magnitude(const Real& x) { return pl::magnitude(x); }
    static PL_INLINE Real copy_sign(const Real& size, const Real& sign) {
        constexpr std::uint32_t kSign = 0x80000000u;
        return std::bit_cast<Real>((std::bit_cast<LaneUint>(size) & ~kSign) |
                                   (std::bit_cast<LaneUint>(sign) & kSign));
    }
    static PL_INLINE Real floor(const Real& x) {
#if defined(__AVX512F__)
        return std::bit_cast<Real>(
            _mm512_maskz_roundscale_ps(0xffff, std::bit_cast<__m512>(x), _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC));
#elif defined(__AVX2__)
        return std::bit_cast<Real>(_mm256_floor_ps(std::bit_cast<__m256>(x)));
#else
        return to_real(floor_of<Lanes>(x));
#endif
    }
    static PL_INLINE Int truncate(const Real& x) { return __builtin_convertvector(x, Int); }
    static PL_INLINE Real to_real(const Int& i) { return __builtin_convertvector(i, Real); }
    static PL_INLINE Real count_to_real(const Uint& i) { return __builtin_convertvector(i, Real); }
    static PL_INLINE Int to_int(const Uint& i) { return std::bit_cast<Int>(i); }
    static PL_INLINE Uint to_count(const Int& i) { return std::bit_cast<Uint>(i); }
    static PL_INLINE Int bits_of(const Real& x) { return std::bit_cast<Int>(x); }
    static PL_INLINE Real from_bits(const Int& bits) { return std::bit_cast<Real>(bits); }
    static PL_INLINE bool any(const Mask& mask) { return mask_bits(mask) != 0; }
    static PL_INLINE Real load(const float* values, const Int& index) {
#if defined(__AVX512F__)
        return std::bit_cast<Real>(
            _mm512_mask_i32gather_ps(_mm512_setzero_ps(), 0xffff, std::bit_cast<__m512i>(index), values, 4));
#elif defined(__AVX2__)
        return std::bit_cast<Real>(_mm256_i32gather_ps(values, std::bit_cast<__m256i>(index), 4));
#else
        Real loaded;
        for (std::uint32_t lane = 0; lane < kLaneWidth; ++lane) loaded[lane] = values[index[lane]];
        return loaded;
#endif
    }
    static PL_INLINE Int load(const std::int32_t* values, const Int& index) { return load_word(values, index); }
    /// Each lane loads a word of 32 bits.
    static PL_INLINE Int load_word(const void* words, const Int& index) {
#if defined(__AVX512F__)
        return std::bit_cast<Int>(
            _mm512_mask_i32gather_epi32(_mm512_setzero_si512(), 0xffff, std::bit_cast<__m512i>(index), words, 4));
#elif defined(__AVX2__)
        return std::bit_cast<Int>(
            _mm256_i32gather_epi32(static_cast<const int*>(words), std::bit_cast<__m256i>(index), 4));
#else
        Int loaded;
        for (std::uint32_t lane = 0; lane < kLaneWidth; ++lane) {
            std::int32_t word;
            std::memcpy(&word, static_cast<const char*>(words) + std::ptrdiff_t{4} * index[lane], sizeof word);
            loaded[lane] = word;
        }
        return loaded;
#endif
    }
    /// Prefetches the words that load() or load_word() with the same arguments reads.
    static PL_INLINE void prefetch(const void* words, const Int& index) {
        std::int32_t indices[kLaneWidth];
        store_lanes(index, indices);
        for (std::uint32_t lane = 0; lane < kLaneWidth; ++lane)
            __builtin_prefetch(static_cast<const char*>(words) + std::ptrdiff_t{4} * indices[lane]);
    }
    /// Each lane searches its own row of values: lane by lane, comparing one vector of values at a time.
    static PL_INLINE Int count_not_above(const float* values, const Int& first, int count, const Real& x) {
        std::int32_t counts[kLaneWidth];
        for (std::uint32_t lane = 0; lane < kLaneWidth; ++lane) {
            const float* row = values + first[lane];
            int index = 0;
            int i = 0;
            for (; i + static_cast<int>(kLaneWidth) <= count; i += static_cast<int>(kLaneWidth))
                index += std::popcount(mask_bits(load_lanes<LaneFloat>(row + i) <= broadcast(x[lane])));
            for (; i < count; ++i) index += row[i] <= x[lane] ? 1 : 0;
            counts[lane] = index;
        }
        return load_lanes<Int>(counts);
    }
};

// Predicates of lanes in the form that costs least: mask registers where vectors have 16 lanes, else vectors.
#if defined(__AVX512F__)
class LaneFlags {
public:
    explicit PL_INLINE LaneFlags(__mmask16 bits) : bits_(bits) {}
    explicit PL_INLINE LaneFlags(const LaneInt& mask) : bits_(static_cast<__mmask16>(mask_bits(mask))) {}

    PL_INLINE std::uint32_t bits() const { return bits_; }
    PL_INLINE bool all() const { return bits_ == 0xffff; }
    PL_INLINE LaneFloat choose(const LaneFloat& yes, const LaneFloat& no) const {
        return std::bit_cast<LaneFloat>(
            _mm512_mask_mov_ps(std::bit_cast<__m512>(no), bits_, std::bit_cast<__m512>(yes)));
    }
    PL_INLINE LaneUint choose(const LaneUint& yes, const LaneUint& no) const {
        return std::bit_cast<LaneUint>(
            _mm512_mask_mov_epi32(std::bit_cast<__m512i>(no), bits_, std::bit_cast<__m512i>(yes)));
    }
    friend PL_INLINE LaneFlags operator&(LaneFlags a, LaneFlags b) {
        return LaneFlags(_kand_mask16(a.bits_, b.bits_));
    }
    friend PL_INLINE LaneFlags operator|(LaneFlags a, LaneFlags b) {
        return LaneFlags(_kor_mask16(a.bits_, b.bits_));
    }
    /// a without b.
    friend PL_INLINE LaneFlags without(LaneFlags a, LaneFlags b) {
        return LaneFlags(_kandn_mask16(b.bits_, a.bits_));
    }

private:
    __mmask16 bits_;
};

template <int kPredicate>
PL_INLINE LaneFlags compare(const LaneFloat& a, const LaneFloat& b) {
    return LaneFlags(_mm512_cmp_ps_mask(std::bit_cast<__m512>(a), std::bit_cast<__m512>(b), kPredicate));
}
PL_INLINE LaneFlags is_zero(const LaneFloat& x) { return compare<_CMP_EQ_OQ>(x, LaneFloat{}); }
PL_INLINE LaneFlags is_positive(const LaneFloat& x) { return compare<_CMP_GT_OQ>(x, LaneFloat{}); }
PL_INLINE LaneFlags is_at_most(const LaneFloat& a, const LaneFloat& b) { return compare<_CMP_LE_OQ>(a, b); }
/// True where one is NaN, too.
PL_INLINE LaneFlags is_not_at_least(const LaneFloat& a, const LaneFloat& b) { return compare<_CMP_NGE_UQ>(a, b); }
PL_INLINE LaneFlags is_equal(const LaneUint& a, std::uint32_t b) {
    return LaneFlags(_mm512_cmpeq_epi32_mask(std::bit_cast<__m512i>(a), _mm512_set1_epi32(static_cast<int>(b))));
}
/// Whether three nonzero numbers differ in their signs.
PL_INLINE LaneFlags have_different_signs(const LaneFloat& a, const LaneFloat& b, const LaneFloat& c) {
    constexpr int kNotAllEqual = 0x7e;  // truth table
    return LaneFlags(_mm512_movepi32_mask(_mm512_ternarylogic_epi32(
        std::bit_cast<__m512i>(a), std::bit_cast<__m512i>(b), std::bit_cast<__m512i>(c), kNotAllEqual)));
}
#else
class LaneFlags {
public:
    explicit PL_INLINE LaneFlags(const LaneInt& mask) : mask_(mask) {}

    PL_INLINE std::uint32_t bits() const { return mask_bits(mask_); }
    PL_INLINE bool all() const { return bits() == (1u << kLaneWidth) - 1u; }
    template <class Vector>
    PL_INLINE Vector choose(const Vector& yes, const Vector& no) const {
        return mask_ ? yes : no;
    }
    friend PL_INLINE LaneFlags operator&(const LaneFlags& a, const LaneFlags& b) {
        return LaneFlags(a.mask_ & b.mask_);
    }
    friend PL_INLINE LaneFlags operator|(const LaneFlags& a, const LaneFlags& b) {
        return LaneFlags(a.mask_ | b.mask_);
    }
    /// a without b.
    friend PL_INLINE LaneFlags without(const LaneFlags& a, const LaneFlags& b) {
        return LaneFlags(a.mask_ & ~b.mask_);
    }

private:
    LaneInt mask_;
};

PL_INLINE LaneFlags is_zero(const LaneFloat& x) { return LaneFlags(x == 0.0f); }
PL_INLINE LaneFlags is_positive(const LaneFloat& x) { return LaneFlags(x > 0.0f); }
PL_INLINE LaneFlags is_at_most(const LaneFloat& a, const LaneFloat& b) { return LaneFlags(a <= b); }
/// True where one is NaN, too.
PL_INLINE LaneFlags is_not_at_least(const LaneFloat& a, const LaneFloat& b) { return LaneFlags(~(a >= b)); }
PL_INLINE LaneFlags is_equal(const LaneUint& a, std::uint32_t b) { return LaneFlags(a == b); }
/// Whether three nonzero numbers differ in their signs.
PL_INLINE LaneFlags have_different_signs(const LaneFloat& a, const LaneFloat& b, const LaneFloat& c) {
    const LaneInt first = std::bit_cast<LaneInt>(a);
    return LaneFlags(((first ^ std::bit_cast<LaneInt>(b)) | (first ^ std::bit_cast<LaneInt>(c))) < 0);
}
#endif

}  // namespace
}  // namespace pl
