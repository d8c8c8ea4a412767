// Linear and bilinear interpolation between equally spaced values.
#pragma once

#include <cstdint>

#include "core/kernel/base/math.h"

namespace pl {

/// The two values to interpolate: (1 - share) * value[low] + share * value[high].
struct Taps {
    std::uint32_t low, high;
    float share;
};

/// Taps at x in [0, 1] among `count` values at the centers of as many equal intervals. Before the first center and
/// after the last one the row wraps around (`starts_over`) or is clamped.
PL_HD inline Taps taps_at(float x, std::uint32_t count, bool starts_over) {
    const float position = x * static_cast<float>(count) - 0.5f;
    const float below = std::floor(position);
    const auto last = static_cast<std::int32_t>(count) - 1;
    const std::int32_t low = clamp_to(static_cast<std::int32_t>(below), -1, last);
    const std::int32_t high = low + 1;
    return {static_cast<std::uint32_t>(low >= 0 ? low : (starts_over ? last : 0)),
            static_cast<std::uint32_t>(high <= last ? high : (starts_over ? 0 : last)), position - below};
}

/// Bilinear interpolation of the low and high values of the upper row and of the lower row.
template <class Value>
PL_HD inline Value bilinear(const Taps& x, const Taps& y, Value low_above, Value high_above, Value low_below,
                            Value high_below) {
    const Value above = (1.0f - x.share) * low_above + x.share * high_above;
    const Value below = (1.0f - x.share) * low_below + x.share * high_below;
    return (1.0f - y.share) * above + y.share * below;
}

}  // namespace pl
