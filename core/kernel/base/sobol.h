// Owen-scrambled points of the first two dimensions of Sobol's sequence, a (0, 2)-sequence in base 2: of any 2^m points that begin
// at a multiple of 2^m, one lies in every elementary interval of area 2^-m. `Word` is a 32-bit unsigned integer, or a vector of them.
#pragma once

#include <cstdint>

#include "core/kernel/base/platform.h"

namespace pl {

template <class Word>
PL_INLINE Word reversed_bits(Word x) {
#if defined(__CUDA_ARCH__)
    return __brev(x);
#else
    x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
    x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);
    return (x >> 16) | (x << 16);
#endif
}

/// A permutation, chosen by `seed`, by which every bit depends on the bits below it alone: Owen's nested uniform scrambling of
/// numbers whose bits are in reverse order.   [Laine and Karras 2011, "Stratified Sampling for Stochastic Transparency", section
/// 3.1; constants of Vegdahl 2021, "Building a Better LK Hash"]
template <class Word>
PL_INLINE Word scramble_reversed(Word x, Word seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

/// Bits, in reverse order, of the second coordinate of point `index`. The bits of the first coordinate are `index`
/// itself. The matrix of the second dimension is Pascal's triangle modulo 2, a product of five shifts.
template <class Word>
PL_INLINE Word sobol_second_reversed(Word index) {
    index ^= index >> 16;
    index ^= (index & 0xff00ff00u) >> 8;
    index ^= (index & 0xf0f0f0f0u) >> 4;
    index ^= (index & 0xccccccccu) >> 2;
    return index ^ ((index & 0xaaaaaaaau) >> 1);
}

/// Well-mixed bits of a word.   [Wellons 2018, "Prospecting for Hash Functions": lowbias32]
template <class Word>
PL_INLINE Word mixed_bits(Word x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    return x ^ (x >> 16);
}

}  // namespace pl
