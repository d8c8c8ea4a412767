// Linear and bilinear interpolation between equally spaced values.
#pragma once

#include <cstdint>

#include "core/kernel/base/numbers.h"

namespace pl {

/// The two values to interpolate: (1 - share) * value[low] + share * value[high].
template <class N>
struct TapsOf {
    typename N::Uint low, high;
    typename N::Real share;
};
using Taps = TapsOf<One>;

/// Taps at x in [0, 1] among `count` values at the centers of as many equal intervals. Before the first center and
/// after the last one the row wraps around (`starts_over`) or is clamped.
template <class N>
PL_INLINE TapsOf<N> taps_at(const typename N::Real& x, std::uint32_t count, bool starts_over) {
    const auto last = static_cast<std::int32_t>(count) - 1;
    const typename N::Real position = x * static_cast<float>(count) - 0.5f;
    const typename N::Real below = N::floor(position);
    const typename N::Int low = clamp_int<N>(N::truncate(below), -1, last);
    const typename N::Int high = low + 1;
    const auto first_tap = select(low >= 0, low, N::constant(starts_over ? last : 0));
    const auto last_tap = select(high <= last, high, N::constant(starts_over ? 0 : last));
    return {N::to_count(first_tap), N::to_count(last_tap), position - below};
}

/// Bilinear interpolation of the low and high values of the upper row and of the lower row.
template <class N, class Value>
PL_INLINE Value bilinear(const TapsOf<N>& x, const TapsOf<N>& y, const Value& low_above, const Value& high_above,
                         const Value& low_below, const Value& high_below) {
    const Value above = (1.0f - x.share) * low_above + x.share * high_above;
    const Value below = (1.0f - x.share) * low_below + x.share * high_below;
    return (1.0f - y.share) * above + y.share * below;
}
template <class N>
PL_INLINE Real3<N> bilinear(const TapsOf<N>& x, const TapsOf<N>& y, const Real3<N>& low_above,
                            const Real3<N>& high_above, const Real3<N>& low_below, const Real3<N>& high_below) {
    return {bilinear(x, y, low_above.x, high_above.x, low_below.x, high_below.x),
            bilinear(x, y, low_above.y, high_above.y, low_below.y, high_below.y),
            bilinear(x, y, low_above.z, high_above.z, low_below.z, high_below.z)};
}

}  // namespace pl
