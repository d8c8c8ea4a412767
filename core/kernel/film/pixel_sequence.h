// Low-discrepancy sequence of film and lens positions over the passes. It removes most of the noise of edges inside a
// pixel, which no sampling of directions can reduce.
#pragma once

#include "core/kernel/base/numbers.h"
#include "core/kernel/base/rng.h"
#include "core/kernel/film/film_view.h"

namespace pl {

/// Sample index of the random start of the sequence of a pass, a number or a vector of them. Each half of the passes,
/// see in_second_half(), has its own, so that the halves stay independent and their difference measures the noise.
template <class Word>
PL_INLINE Word sequence_of(Word pass) {
    return pass & 1u;
}

/// (start + steps * step * 2^-32) mod 1, for a start in [0,1) that is a multiple of 2^-24.
template <class N>
PL_INLINE typename N::Real moved_by_steps(const typename N::Real& start, std::uint32_t step, std::uint32_t steps) {
    return to_unit<N>(N::to_count(N::truncate(start * 16777216.0f)) * 256u + step * steps);
}
PL_HD inline float moved_by_steps(float start, std::uint32_t step, std::uint32_t steps) {
    return moved_by_steps<One>(start, step, steps);
}

/// The point of the film alone, see sequence_point().
template <class N>
PL_INLINE Real2<N> film_point(const Real2<N>& start, std::uint32_t steps) {
    return {moved_by_steps<N>(start.x, 0xc13fa9a9u, steps), moved_by_steps<N>(start.y, 0x91e10da5u, steps)};
}

/// Point of a sequence in [0,1)^4: x, y on the film, z, w on the lens. `start`, uniform, is a random shift that makes every
/// point uniform. Additive recurrence by powers of the plastic number (film) and by sqrt(2), sqrt(3) (lens).   [Roberts
/// 2018, "The Unreasonable Effectiveness of Quasirandom Sequences"; Cranley and Patterson 1976, "Randomization of Number
/// Theoretic Methods for Multiple Integration"]
PL_HD inline Vec4f sequence_point(Vec4f start, std::uint32_t steps) {
    const Real2<One> film = film_point<One>({start.x, start.y}, steps);
    return {film.x, film.y, moved_by_steps(start.z, 0x6a09e667u, steps), moved_by_steps(start.w, 0xbb67ae85u, steps)};
}

/// Steps of a pixel's sequence at a pass.
PL_HD inline std::uint32_t sequence_steps(std::uint32_t pass) { return pass / 2; }

/// The point of a pixel for a pass. `start` is the draw of sample sequence_of(pass) for vertex 0 and Purpose::Pixel.
PL_HD inline Vec4f pixel_sample(Vec4f start, std::uint32_t pass) {
    return sequence_point(start, sequence_steps(pass));
}

}  // namespace pl
