// Random numbers of paths in SIMD lanes. Included by one file per instruction set; see lanes.h.
#pragma once

#include "core/kernel/film/vertex_sequence.h"
#include "cpu/base/lane_kernels.h"
#include "cpu/lanes/lanes.h"

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

/// Evaluates Rng::bits for the lanes of a group from lane `first`, with these sample numbers.
PL_INLINE PhiloxWords<LaneUint> bits_lanes(const DrawKey& key, const CounterGroup& counters, std::uint32_t first,
                                           LaneUint sample) {
    const PhiloxWords<LaneUint> counter{
        {load_lanes<LaneUint>(counters.pixel + first), sample,
         load_lanes<LaneUint>(counters.vertex + first) | (static_cast<std::uint32_t>(key.purpose) << 24),
         broadcast(static_cast<std::uint32_t>(key.stream))}};
    return philox4x32(counter, static_cast<std::uint32_t>(key.seed), static_cast<std::uint32_t>(key.seed >> 32),
                      [](std::uint32_t factor, LaneUint words) { return multiply_lanes(factor, words); });
}

PL_INLINE void store_uniforms(const PhiloxWords<LaneUint>& bits, UniformGroup& uniforms, std::uint32_t first) {
    for (int i = 0; i < 4; ++i) store_lanes(to_unit<Lanes>(bits.v[i]), uniforms.rows[i] + first);
}

void draw(const DrawKey& key, const CounterGroup* counters, UniformGroup* uniforms, std::uint32_t groups) {
    for (std::uint32_t group = 0; group < groups; ++group)
        for (std::uint32_t first = 0; first < kGroupSize; first += kLaneWidth) {
            const auto sample = load_lanes<LaneUint>(counters[group].sample + first);
            store_uniforms(bits_lanes(key, counters[group], first, sample), uniforms[group], first);
        }
}

/// Evaluates vertex_uniforms() for the lanes of a group from lane `first`.
PL_INLINE PhiloxWords<LaneUint> vertex_bits_lanes(const DrawKey& key, const CounterGroup& counters,
                                                  std::uint32_t first) {
    const auto sample = load_lanes<LaneUint>(counters.sample + first);
    const LaneInt spread = load_lanes<LaneUint>(counters.vertex + first) == kSpreadVertex;
    if (key.stream != Stream::Picture || mask_bits(spread) == 0) return bits_lanes(key, counters, first, sample);
    const auto [sequence, steps] = sequence_member(key.sequences, sample);
    PhiloxWords<LaneUint> bits = bits_lanes(key, counters, first, spread ? sequence : sample);
    const LaneUint seed =
        sequence_seed(key.seed, load_lanes<LaneUint>(counters.pixel + first), sequence, key.purpose);
    const PhiloxWords<LaneUint> members = spread_bits<Lanes>(bits, seed, steps);
    for (int i = 0; i < 4; ++i) bits.v[i] = spread ? members.v[i] : bits.v[i];
    return bits;
}

void draw_vertices(const DrawKey& key, const CounterGroup* counters, UniformGroup* uniforms, std::uint32_t groups) {
    for (std::uint32_t group = 0; group < groups; ++group)
        for (std::uint32_t first = 0; first < kGroupSize; first += kLaneWidth)
            store_uniforms(vertex_bits_lanes(key, counters[group], first), uniforms[group], first);
}

}  // namespace
}  // namespace pl
