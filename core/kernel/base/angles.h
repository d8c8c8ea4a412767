// Trigonometry on angles in turns (1 turn = 2 pi). Own polynomials: the math libraries of CPU and GPU round
// differently.
#pragma once

#include "core/kernel/base/numbers.h"

namespace pl {

struct SineCosine {
    float sine, cosine;
};

/// Sine and cosine of an angle in quarters of a turn, of which `nearest` is the nearest whole number.
PL_HD inline SineCosine sine_cosine_of_quarters(float quarters, float nearest) {
    const float x = (quarters - nearest) * (2.0f * kPiOver4);
    const float sine = sin_quarter<One>(x);
    const float cosine = cos_quarter<One>(x);
    switch (static_cast<int>(nearest) & 3) {
    case 0: return {sine, cosine};
    case 1: return {cosine, -sine};
    case 2: return {-sine, -cosine};
    default: return {-cosine, sine};
    }
}

/// Sine and cosine of an angle in turns, |turns| <= 1e6. Absolute error below 1e-6 for |turns| < 1.
PL_HD inline SineCosine sine_cosine_of_turns(float turns) {
    return sine_cosine_of_quarters(4.0f * turns, std::floor(4.0f * turns + 0.5f));
}

/// The same of an angle that is not negative: a rounding down is dearer than a truncation.
PL_HD inline SineCosine sine_cosine_of_positive_turns(float turns) {
    return sine_cosine_of_quarters(4.0f * turns, static_cast<float>(static_cast<int>(4.0f * turns + 0.5f)));
}

/// atan2(y, x) in turns, in [-1/2, 1/2]; 0 at the origin. Absolute error below 1e-7 turns.
PL_HD inline float turns_of(float y, float x) {
    const float across = std::fabs(y);
    const float along = std::fabs(x);
    if (across == 0.0f && along == 0.0f) return 0.0f;
    const float angle =
        across <= along ? atan_unit<One>(across / along) : 2.0f * kPiOver4 - atan_unit<One>(along / across);
    const float turns = angle * (0.5f * kInvPi);
    return std::copysign(x < 0.0f ? 0.5f - turns : turns, y);
}

}  // namespace pl
