// Median and quartiles of a few measurements.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace pl::benchmarks {

struct Quartiles {
    double lower, median, upper;
};

/// Linear interpolation between order statistics; `values` must not be empty.
inline Quartiles quartiles_of(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const auto at = [&](double share) {
        const double position = share * static_cast<double>(values.size() - 1);
        const auto below = static_cast<std::size_t>(std::floor(position));
        const std::size_t above = std::min(below + 1, values.size() - 1);
        return values[below] + (position - static_cast<double>(below)) * (values[above] - values[below]);
    };
    return {at(0.25), at(0.5), at(0.75)};
}

}  // namespace pl::benchmarks
