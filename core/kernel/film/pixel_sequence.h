// Low-discrepancy sequence of film and lens positions over the passes. It removes most of the noise of edges inside a
// pixel, which no sampling of directions can reduce.
#pragma once

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
PL_HD inline float moved_by_steps(float start, std::uint32_t step, std::uint32_t steps) {
    return to_unit_float(static_cast<std::uint32_t>(start * 16777216.0f) * 256u + step * steps);
}

/// Point of a sequence in [0,1)^4: x, y on the film, z, w on the lens. `start`, uniform, is a random shift that makes every
/// point uniform. Additive recurrence by powers of the plastic number (film) and by sqrt(2), sqrt(3) (lens).   [Roberts
/// 2018, "The Unreasonable Effectiveness of Quasirandom Sequences"; Cranley and Patterson 1976, "Randomization of Number
/// Theoretic Methods for Multiple Integration"]
PL_HD inline Vec4f sequence_point(Vec4f start, std::uint32_t steps) {
    return {moved_by_steps(start.x, 0xc13fa9a9u, steps), moved_by_steps(start.y, 0x91e10da5u, steps),
            moved_by_steps(start.z, 0x6a09e667u, steps), moved_by_steps(start.w, 0xbb67ae85u, steps)};
}

/// The point of a pixel for a pass. `start` is the draw of sample sequence_of(pass) for vertex 0 and Purpose::Pixel.
PL_HD inline Vec4f pixel_sample(Vec4f start, std::uint32_t pass) { return sequence_point(start, pass / 2); }

}  // namespace pl
