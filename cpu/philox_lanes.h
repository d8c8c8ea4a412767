// Philox random numbers in SIMD lanes. Included by one file per instruction set; see lanes.h.
#pragma once

#include "core/kernel/base/rng.h"
#include "cpu/lane_kernels.h"
#include "cpu/lanes.h"

namespace pl {
namespace {

/// 64-bit products of 32-bit lanes and one factor.
PL_INLINE WideProduct<LaneUint> multiply_lanes(std::uint32_t factor, LaneUint words) {
    constexpr std::uint64_t kLowHalf = 0xffffffffu;
    const auto pairs = std::bit_cast<LaneWide>(words);
    const LaneWide even = multiply_low_halves(pairs, factor);
    const LaneWide odd = multiply_low_halves(pairs >> 32, factor);
    return {std::bit_cast<LaneUint>((even >> 32) | (odd & ~kLowHalf)),
            std::bit_cast<LaneUint>((even & kLowHalf) | (odd << 32))};
}

/// Evaluates Rng::draw for the lanes of a group from lane `first`.
PL_INLINE PhiloxWords<LaneFloat> draw_lanes(const DrawKey& key, const CounterGroup& counters, std::uint32_t first) {
    const PhiloxWords<LaneUint> counter{
        {load_lanes<LaneUint>(counters.pixel + first), load_lanes<LaneUint>(counters.sample + first),
         load_lanes<LaneUint>(counters.vertex + first) | (static_cast<std::uint32_t>(key.purpose) << 24),
         broadcast(static_cast<std::uint32_t>(key.stream))}};
    const PhiloxWords<LaneUint> block =
        philox4x32(counter, static_cast<std::uint32_t>(key.seed), static_cast<std::uint32_t>(key.seed >> 32),
                   [](std::uint32_t factor, LaneUint words) { return multiply_lanes(factor, words); });
    return {
        {to_unit_lanes(block.v[0]), to_unit_lanes(block.v[1]), to_unit_lanes(block.v[2]), to_unit_lanes(block.v[3])}};
}

PL_INLINE void draw_groups(const DrawKey& key, const CounterGroup* counters, NumberGroup* numbers,
                           std::uint32_t groups) {
    for (std::uint32_t group = 0; group < groups; ++group)
        for (std::uint32_t first = 0; first < kGroupSize; first += kLaneWidth) {
            const PhiloxWords<LaneFloat> drawn = draw_lanes(key, counters[group], first);
            for (int i = 0; i < 4; ++i) store_lanes(drawn.v[i], numbers[group].rows[i] + first);
        }
}

}  // namespace
}  // namespace pl
