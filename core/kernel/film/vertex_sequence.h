// Low-discrepancy numbers of a path's first vertex over the passes: its direction and its light sample are spread evenly, as the
// film positions of pixel_sequence.h are. Later vertices lie elsewhere in every pass, and draw independent numbers.
#pragma once

#include "core/kernel/base/sobol.h"
#include "core/kernel/film/pixel_sequence.h"

namespace pl {

/// The vertex whose numbers are spread over the passes, on camera paths: others have no passes.
inline constexpr std::uint32_t kSpreadVertex = 1;

/// Seed of the scrambling of a pixel's sequence.
template <class Word>
PL_INLINE Word sequence_seed(std::uint64_t seed, Word pixel, Word sequence, Purpose purpose) {
    const auto low = static_cast<std::uint32_t>(seed);
    const auto high = static_cast<std::uint32_t>(seed >> 32);
    const Word which = sequence + (2u * static_cast<std::uint32_t>(purpose) + mixed_bits(high));
    return mixed_bits(pixel + mixed_bits(which + low));
}

/// Member number `steps` of a sequence, as random bits. Members x, w, and y and z together, are Owen-scrambled Sobol points in an
/// order shuffled for each of the three, so that none depends on another [Burley 2020, "Practical Hash-based Owen Scrambling"].
/// `shift` is uniform and independent of `seed`: it makes every member exactly uniform.
template <class N, class Word = typename N::Uint>
PL_INLINE PhiloxWords<Word> spread_bits(const PhiloxWords<Word>& shift, Word seed, Word steps) {
    const Word other = mixed_bits(seed + 0x9e3779b9u);
    const Word reversed = N::reversed(steps);
    const Word index_x = N::reversed(scramble_reversed(reversed, seed));
    const Word index_yz = N::reversed(scramble_reversed(reversed, other));
    const Word scramble = mixed_bits(other + 0x9e3779b9u);
    const Word scramble_z = scramble * 0x2c1b3c6du + 0x297a2d39u;
    const Word last = mixed_bits(scramble + 0x9e3779b9u);
    const Word index_w = N::reversed(scramble_reversed(reversed, last));
    return {{shift.v[0] ^ N::reversed(scramble_reversed(index_x, scramble)),
             shift.v[1] ^ N::reversed(scramble_reversed(index_yz, scramble)),
             shift.v[2] ^ N::reversed(scramble_reversed(sobol_second_reversed(index_yz), scramble_z)),
             shift.v[3] ^ N::reversed(scramble_reversed(index_w, scramble))}};
}

/// The sequences that first vertices draw from, one for each half of the passes: named by numbers, so that a new name gives fresh ones.
struct VertexSequences {
    std::uint32_t name = 0;          ///< of the first; the other has the next number
    std::uint32_t first_sample = 0;  ///< the pass of their first members

    friend bool operator==(const VertexSequences&, const VertexSequences&) = default;
};

/// The member that a pass draws.
template <class Word>
struct SequenceMember {
    Word sequence;
    Word steps;  ///< members before it
};
template <class Word>
PL_INLINE SequenceMember<Word> sequence_member(const VertexSequences& sequences, Word sample) {
    const Word passes = sample - sequences.first_sample;
    return {sequences.name + (passes & 1u), passes >> 1};
}

/// The numbers of a path for a vertex and purpose: Rng::draw(), or a member of a sequence.
PL_HD inline Vec4f vertex_uniforms(const Rng& rng, const VertexSequences& sequences, std::uint32_t vertex,
                                   Purpose purpose) {
    const bool is_spread = vertex == kSpreadVertex && rng.stream == Stream::Picture;
    const auto [sequence, steps] = sequence_member(sequences, rng.sample);
    // One call for both cases, which the lanes of a warp make together.
    Philox words = Rng{rng.seed, rng.stream, rng.pixel, is_spread ? sequence : rng.sample}.bits(vertex, purpose);
    if (is_spread) words = spread_bits<One>(words, sequence_seed(rng.seed, rng.pixel, sequence, purpose), steps);
    return to_unit_floats(words);
}

}  // namespace pl
