// Square tiles of kLaneWidth vectors, and vectors of 64-bit integers. See cpu/lanes/lanes.h.
#pragma once

#include <utility>

#include "cpu/lanes/lanes.h"

namespace pl {
namespace {

/// kLaneWidth vectors; arithmetic along a row of the tile is in sequence, across rows in lanes.
struct LaneTile {
    LaneFloat rows[kLaneWidth];
};

/// Lane i of the result is lane kLaneOf(i) of `a` followed by `b`.
template <int (*kLaneOf)(int), std::size_t... kLanes>
PL_INLINE LaneFloat pick_lanes(const LaneFloat& a, const LaneFloat& b, std::index_sequence<kLanes...>) {
    return __builtin_shufflevector(a, b, kLaneOf(static_cast<int>(kLanes))...);
}
template <int (*kLaneOf)(int)>
PL_INLINE LaneFloat pick_lanes(const LaneFloat& a, const LaneFloat& b) {
    return pick_lanes<kLaneOf>(a, b, std::make_index_sequence<kLaneWidth>());
}

/// In each block of four lanes: the first (kUpper = 0) or last two of `a` and `b` in turns.
template <int kUpper>
constexpr int interleaved(int i) {
    return (i & ~3) + 2 * kUpper + ((i & 3) >> 1) + (i & 1) * static_cast<int>(kLaneWidth);
}
/// In each block of 2 * kSize lanes: the first (kUpper = 0) or last kSize lanes of `a`, then of `b`.
template <int kSize, int kUpper>
constexpr int joined(int i) {
    const int in_block = i & (2 * kSize - 1);
    const int of_b = in_block >= kSize ? static_cast<int>(kLaneWidth) - kSize : 0;
    return i + of_b + kUpper * kSize;
}

template <int kSize>
PL_INLINE void exchange(LaneFloat& a, LaneFloat& b) {
    const LaneFloat lower = pick_lanes<joined<kSize, 0>>(a, b);
    b = pick_lanes<joined<kSize, 1>>(a, b);
    a = lower;
}

template <int kSize>
PL_INLINE void exchange_blocks(LaneTile& tile) {
    if constexpr (kSize < static_cast<int>(kLaneWidth)) {
#pragma GCC unroll 16
        for (std::uint32_t i = 0; i < kLaneWidth; ++i)
            if ((i & kSize) == 0) exchange<kSize>(tile.rows[i], tile.rows[i + kSize]);
        exchange_blocks<2 * kSize>(tile);
    }
}

/// Blocks of 4 x 4 first, then ever larger blocks change places.
PL_INLINE void transpose(LaneTile& tile) {
#pragma GCC unroll 4
    for (std::uint32_t i = 0; i < kLaneWidth; i += 4) {
        LaneFloat* rows = tile.rows + i;
        const LaneFloat a = pick_lanes<interleaved<0>>(rows[0], rows[1]);
        const LaneFloat b = pick_lanes<interleaved<1>>(rows[0], rows[1]);
        const LaneFloat c = pick_lanes<interleaved<0>>(rows[2], rows[3]);
        const LaneFloat d = pick_lanes<interleaved<1>>(rows[2], rows[3]);
        rows[0] = pick_lanes<joined<2, 0>>(a, c);
        rows[1] = pick_lanes<joined<2, 1>>(a, c);
        rows[2] = pick_lanes<joined<2, 0>>(b, d);
        rows[3] = pick_lanes<joined<2, 1>>(b, d);
    }
    exchange_blocks<4>(tile);
}

/// The lanes of `middle` moved up by one, with the last of `before` in front, and moved down by one.
constexpr int one_up(int i) { return static_cast<int>(kLaneWidth) - 1 + i; }
constexpr int one_down(int i) { return i + 1; }
PL_INLINE LaneFloat from_left(const LaneFloat& before, const LaneFloat& middle) {
    return pick_lanes<one_up>(before, middle);
}
PL_INLINE LaneFloat from_right(const LaneFloat& middle, const LaneFloat& after) {
    return pick_lanes<one_down>(middle, after);
}

/// Half of the lanes, as 64-bit integers and as floats.
using LaneLong = std::int64_t __attribute__((vector_size(4 * kLaneWidth)));
using LaneDouble = double __attribute__((vector_size(4 * kLaneWidth)));
using HalfFloat = float __attribute__((vector_size(2 * kLaneWidth)));

template <std::size_t... kLanes>
PL_INLINE LaneFloat join_halves(const HalfFloat& low, const HalfFloat& high, std::index_sequence<kLanes...>) {
    return __builtin_shufflevector(low, high, static_cast<int>(kLanes)...);
}

/// The nearest floats.
PL_INLINE HalfFloat round_to_float(const LaneLong& integers) {
#if !defined(__AVX512DQ__)
    // Without an instruction for it: up to 52 bits by way of the mantissa of a double, which holds them exactly.
    constexpr std::int64_t kBits = 0x4330000000000000;  // of 2^52
    const LaneWide above = std::bit_cast<LaneWide>(integers) >> 52;
    if (!Lanes::any(std::bit_cast<LaneUint>(above) != 0u))
        return __builtin_convertvector(std::bit_cast<LaneDouble>(integers | kBits) - 0x1p52, HalfFloat);
#endif
    return __builtin_convertvector(integers, HalfFloat);
}

/// The nearest floats of kLaneWidth integers.
PL_INLINE LaneFloat load_rounded(const std::int64_t* values) {
    return join_halves(round_to_float(load_lanes<LaneLong>(values)),
                       round_to_float(load_lanes<LaneLong>(values + kLaneWidth / 2)),
                       std::make_index_sequence<kLaneWidth>());
}

/// Each lane of one half twice.
template <int kHalf>
constexpr int doubled(int i) {
    return (kHalf * static_cast<int>(kLaneWidth) + i) / 2;
}

/// Sets to 0 the integers whose lanes in the mask are set.
template <int kHalf>
PL_INLINE void clear_half(std::int64_t* values, const LaneFloat& mask) {
    const auto wide = std::bit_cast<LaneLong>(pick_lanes<doubled<kHalf>>(mask, mask));
    std::int64_t* half = values + kHalf * (kLaneWidth / 2);
    store_lanes(load_lanes<LaneLong>(half) & ~wide, half);
}
PL_INLINE void clear_where(const LaneInt& mask, std::int64_t* values) {
    clear_half<0>(values, std::bit_cast<LaneFloat>(mask));
    clear_half<1>(values, std::bit_cast<LaneFloat>(mask));
}

}  // namespace
}  // namespace pl
