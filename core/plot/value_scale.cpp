#include "core/plot/value_scale.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace pl {
namespace {

/// Percentile of values in ascending order, by the nearest rank.
float percentile(const std::vector<float>& sorted, float percent) {
    const float rank = std::clamp(0.01f * percent, 0.0f, 1.0f) * static_cast<float>(sorted.size() - 1);
    return sorted[static_cast<std::size_t>(std::lround(rank))];
}

}  // namespace

float ValueRange::position(float value) const {
    if (!(value > low)) return 0.0f;
    if (value >= high) return 1.0f;
    if (scale == ColorScale::Linear) return (value - low) / (high - low);
    return std::clamp(std::log(value / low) / std::log(high / low), 0.0f, 1.0f);
}

float ValueRange::value_at(float position) const {
    if (scale == ColorScale::Linear) return low + position * (high - low);
    return low * std::pow(high / low, position);
}

ValueRange range_of(std::span<const float> values, const RangeRule& rule) {
    std::vector<float> sorted(values.begin(), values.end());
    std::ranges::sort(sorted);
    if (sorted.empty() || !(sorted.back() > 0.0f)) sorted = {1.0f};
    ValueRange range{.scale = rule.scale, .low = 0.0f, .high = percentile(sorted, rule.high_percent)};
    if (!(range.high > 0.0f)) range.high = sorted.back();
    const bool is_linear = rule.scale == ColorScale::Linear;
    const float low = is_linear && !(rule.low_percent > 0.0f) ? 0.0f : percentile(sorted, rule.low_percent);
    const float least = is_linear ? 0.0f : range.high * std::pow(10.0f, -kShownDecades);
    range.low = low > least && low < range.high ? low : least;
    return range;
}

}  // namespace pl
