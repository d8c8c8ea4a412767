// The range of values that a color map covers, and where a value lies in it.
#pragma once

#include <span>

namespace pl {

enum class ColorScale { Linear, Logarithmic };

/// How a range is chosen from the values shown: from one percentile of them to another.
struct RangeRule {
    ColorScale scale = ColorScale::Logarithmic;  ///< a lamp is brighter than all other directions together
    float low_percent = 0.0f;                    ///< in [0, 100]; 0 on a linear scale: from the value 0
    float high_percent = 100.0f;                 ///< in [0, 100], not below the other

    friend bool operator==(const RangeRule&, const RangeRule&) = default;
};

/// Decades that a logarithmic range has at most.
inline constexpr float kShownDecades = 3.0f;

/// low < high, both finite; low > 0 on a logarithmic scale.
struct ValueRange {
    ColorScale scale = ColorScale::Linear;
    float low = 0.0f;
    float high = 1.0f;

    /// 0 at and below `low`, 1 at and above `high`.
    float position(float value) const;
    /// The value at a position in [0, 1].
    float value_at(float position) const;

    friend bool operator==(const ValueRange&, const ValueRange&) = default;
};

/// The range of non-negative values, in any order and of any number. If all are 0 the range ends at 1.
ValueRange range_of(std::span<const float> values, const RangeRule& rule);

}  // namespace pl
