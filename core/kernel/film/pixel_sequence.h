// Where in its pixel, and on the lens, the path of a pass starts: spread evenly over the passes, because what a pixel holds
// at its border, half a lamp and half a wall, would else be noise that no choice of directions can take away.
#pragma once

#include "core/kernel/base/rng.h"
#include "core/kernel/film/film_view.h"

namespace pl {

/// The sample whose random numbers start the sequence of a pass. Each half of the passes has a sequence of its own, so that the
/// halves are independent and still tell what is noise.
PL_HD inline std::uint32_t sequence_of(std::uint32_t pass) { return in_second_half(pass) ? 1u : 0u; }

/// A number of [0,1), a multiple of 2^-24, moved by `steps` times `step` 2^-32, modulo 1.
PL_HD inline float moved_by_steps(float start, std::uint32_t step, std::uint32_t steps) {
    return to_unit_float(static_cast<std::uint32_t>(start * 16777216.0f) * 256u + step * steps);
}

/// The member of a pixel's sequence that belongs to a pass, in [0,1)^4: x and y on the film, z and w on the lens. `start` is what
/// sequence_of(pass) draws for vertex 0 and Purpose::Pixel, so every member alone is uniform. An additive recurrence: the film by
/// powers of the plastic number, the lens by the roots of 2 and 3.   [Roberts 2018, "The Unreasonable Effectiveness of
/// Quasirandom Sequences"; Cranley and Patterson 1976, "Randomization of Number Theoretic Methods for Multiple Integration"]
PL_HD inline Vec4f pixel_sample(Vec4f start, std::uint32_t pass) {
    const std::uint32_t steps = pass / 2;
    return {moved_by_steps(start.x, 0xc13fa9a9u, steps), moved_by_steps(start.y, 0x91e10da5u, steps),
            moved_by_steps(start.z, 0x6a09e667u, steps), moved_by_steps(start.w, 0xbb67ae85u, steps)};
}

}  // namespace pl
