#include "core/measure/jackknife.h"

#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace pl {

double without_bias(const GroupFigure& figure, GroupSet groups) {
    return 2.0 * figure(groups) - 0.5 * (figure(groups & kEvenGroups) + figure(groups & kOddGroups));
}

Interval jackknife_interval(const GroupFigure& figure) {
    constexpr int kPairs = 16;
    std::array<double, kPairs> values{};
    for (int pair = 0; pair < kPairs; ++pair)
        values[static_cast<std::size_t>(pair)] = figure(kAllGroups & ~(3u << (2 * pair)));
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / kPairs;
    double squares = 0.0;
    for (const double value : values) squares += (value - mean) * (value - mean);
    const double error = std::sqrt(squares * (kPairs - 1) / kPairs);
    const double half = student_quantile(0.5 + 0.5 * kConfidence, kPairs - 1) * error;
    const double value = figure(kAllGroups);
    return {value, value - half, value + half};
}

Interval jackknife_ratio(const GroupFigure& figure) {
    const Interval log = jackknife_interval([&](GroupSet set) { return std::log(figure(set)); });
    if (!std::isfinite(log.low) || !std::isfinite(log.high))
        return {figure(kAllGroups), 0.0, std::numeric_limits<double>::infinity()};
    return {std::exp(log.value), std::exp(log.low), std::exp(log.high)};
}

}  // namespace pl
