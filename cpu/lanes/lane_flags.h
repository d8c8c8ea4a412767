// Predicates of lanes in the form that costs least: mask registers where vectors have 16 lanes, else vectors. Included by one file per
// instruction set; see lanes.h.
#pragma once

#include "cpu/lanes/lanes.h"

namespace pl {
namespace {

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
