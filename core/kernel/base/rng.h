// Counter-based random numbers: no state to carry, and any sample can be replayed alone. Philox4x32-10   [Salmon et
// al. 2011, "Parallel Random Numbers: As Easy as 1, 2, 3", section 3.3]
#pragma once

#include <cstdint>

#include "core/kernel/base/math.h"

namespace pl {

/// Purpose of a draw. Every effect has its own, so enabling one never shifts the random numbers of another.
enum class Purpose : std::uint32_t {
    Pixel = 0,      ///< start of the film and lens sequences, see pixel_sample()
    Scatter = 1,    ///< one-sample MIS strategy, direction (2), Russian roulette
    Light = 3,      ///< choice of a light, point on it
    Probe = 4,      ///< first direction of a probe
    Placement = 5,  ///< placement of radiance volumes
    Lobe = 6,       ///< choice among the lobes of a surface
    Emission = 7,   ///< further camera rays for emission alone, see camera_emission.h
};

/// Independent families of random numbers: camera paths, probes, placement and inspections never share one.
enum class Stream : std::uint32_t { Picture = 0, Precompute = 1, Placement = 2, Inspection = 4 };

/// A 128-bit counter or block of random bits; `Word` is a 32-bit integer, or a vector of them.
template <class Word>
struct PhiloxWords {
    Word v[4];
};
using Philox = PhiloxWords<std::uint32_t>;

/// The two halves of a 64-bit product.
template <class Word>
struct WideProduct {
    Word high, low;
};

/// One Philox4x32-10 block: a keyed bijection of 128-bit counters. `multiply(factor, word)` gives a WideProduct.
template <class Word, class Multiply>
PL_INLINE PhiloxWords<Word> philox4x32(PhiloxWords<Word> counter, std::uint32_t key0, std::uint32_t key1,
                                       Multiply multiply) {
    for (int round = 0; round < 10; ++round) {
        const WideProduct<Word> product0 = multiply(0xD2511F53u, counter.v[0]);
        const WideProduct<Word> product1 = multiply(0xCD9E8D57u, counter.v[2]);
        counter = {
            {product1.high ^ counter.v[1] ^ key0, product1.low, product0.high ^ counter.v[3] ^ key1, product0.low}};
        key0 += 0x9E3779B9u;
        key1 += 0xBB67AE85u;
    }
    return counter;
}

PL_HD inline Philox philox4x32(Philox counter, std::uint32_t key0, std::uint32_t key1) {
    return philox4x32(counter, key0, key1, [](std::uint32_t factor, std::uint32_t word) {
        const std::uint64_t product = std::uint64_t{factor} * word;
        return WideProduct<std::uint32_t>{static_cast<std::uint32_t>(product >> 32),
                                          static_cast<std::uint32_t>(product)};
    });
}

/// Uniform in [0, 1): the top 24 bits, so that 1.0 can never appear.
PL_HD inline float to_unit_float(std::uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f; }

PL_HD inline Vec4f to_unit_floats(const Philox& block) {
    return {to_unit_float(block.v[0]), to_unit_float(block.v[1]), to_unit_float(block.v[2]),
            to_unit_float(block.v[3])};
}

/// Random numbers of one path: a pure function of (seed, stream, pixel, sample, vertex, purpose).
struct Rng {
    std::uint64_t seed = 0;
    Stream stream = Stream::Picture;
    std::uint32_t pixel = 0;  ///< or the index of the probe
    std::uint32_t sample = 0;

    /// Random bits for this vertex and purpose.
    PL_HD Philox bits(std::uint32_t vertex, Purpose purpose) const {
        PL_ASSERT(vertex < (1u << 24));
        const Philox counter{{pixel, sample, vertex | (static_cast<std::uint32_t>(purpose) << 24),
                              static_cast<std::uint32_t>(stream)}};
        return philox4x32(counter, static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32));
    }

    /// A uniform point of [0, 1)^4 for this vertex and purpose.
    PL_HD Vec4f draw(std::uint32_t vertex, Purpose purpose) const { return to_unit_floats(bits(vertex, purpose)); }
};

}  // namespace pl
