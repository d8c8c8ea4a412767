// Trigonometry on angles in turns (1 turn = 2 pi). Own polynomials: the math libraries of CPU and GPU round
// differently.
#pragma once

#include "core/kernel/base/numbers.h"

namespace pl {

template <class N>
struct SineCosineOf {
    typename N::Real sine, cosine;
};
using SineCosine = SineCosineOf<One>;

/// Sine and cosine of an angle in quarters of a turn, of which `nearest` is the nearest whole number.
template <class N>
PL_INLINE SineCosineOf<N> sine_cosine_of_quarters(const typename N::Real& quarters, const typename N::Real& nearest) {
    const typename N::Real x = (quarters - nearest) * (2.0f * kPiOver4);
    const typename N::Real sine = sin_quarter<N>(x);
    const typename N::Real cosine = cos_quarter<N>(x);
    const typename N::Int turned = N::truncate(nearest) & 3;
    const typename N::Mask is_odd = (turned & 1) != 0;
    const typename N::Real of_sine = select(is_odd, cosine, sine);
    const typename N::Real of_cosine = select(is_odd, sine, cosine);
    return {select(static_cast<typename N::Mask>(turned >= 2), -of_sine, of_sine),
            select(static_cast<typename N::Mask>(((turned + 1) & 2) != 0), -of_cosine, of_cosine)};
}

/// Sine and cosine of an angle in turns, |turns| <= 1e6. Absolute error below 1e-6 for |turns| < 1.
template <class N>
PL_INLINE SineCosineOf<N> sine_cosine_of_turns(const typename N::Real& turns) {
    return sine_cosine_of_quarters<N>(4.0f * turns, N::floor(4.0f * turns + 0.5f));
}
PL_HD inline SineCosine sine_cosine_of_turns(float turns) { return sine_cosine_of_turns<One>(turns); }

/// sine_cosine_of_turns() of an angle that is not negative, by a truncation, which is faster than rounding down.
template <class N>
PL_INLINE SineCosineOf<N> sine_cosine_of_positive_turns(const typename N::Real& turns) {
    return sine_cosine_of_quarters<N>(4.0f * turns, N::to_real(N::truncate(4.0f * turns + 0.5f)));
}
PL_HD inline SineCosine sine_cosine_of_positive_turns(float turns) {
    return sine_cosine_of_positive_turns<One>(turns);
}

/// atan2(y, x) in turns, in [-1/2, 1/2]; 0 at the origin. Absolute error below 1e-7 turns.
template <class N>
PL_INLINE typename N::Real turns_of(const typename N::Real& y, const typename N::Real& x) {
    const typename N::Real across = N::magnitude(y);
    const typename N::Real along = N::magnitude(x);
    const typename N::Mask is_flat = across <= along;
    const typename N::Real least = select(is_flat, across, along);
    const typename N::Real slope = least / select(is_flat, along, across);
    const typename N::Real of_slope = atan_unit<N>(slope);
    const typename N::Real turns = select(is_flat, of_slope, 2.0f * kPiOver4 - of_slope) * (0.5f * kInvPi);
    const typename N::Real angle =
        N::copy_sign(select(static_cast<typename N::Mask>(x < 0.0f), 0.5f - turns, turns), y);
    const typename N::Mask is_origin = (across == 0.0f) & (along == 0.0f);
    return select(is_origin, N::constant(0.0f), angle);
}
PL_HD inline float turns_of(float y, float x) { return turns_of<One>(y, x); }

}  // namespace pl
