// How far two arrays of the same kind are from equal to the bit.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>
#include <vector>

#include "core/kernel/base/math.h"

namespace pl::parity {

/// Of numbers: floats and integers, vectors counted by component, structs of other kinds as one value each.
struct Difference {
    std::size_t values = 0;
    std::size_t differing = 0;
    double largest =
        0.0;  ///< absolute; infinite for lengths or structs that differ, and where one value alone is NaN

    double share() const { return values == 0 ? 0.0 : static_cast<double>(differing) / static_cast<double>(values); }
    bool is_none() const { return differing == 0; }
};

template <class T>
void compare_values(Difference& total, const T& a, const T& b) {
    ++total.values;
    if (std::memcmp(&a, &b, sizeof(T)) == 0) return;
    ++total.differing;
    double distance = std::numeric_limits<double>::infinity();
    if constexpr (std::is_arithmetic_v<T>) distance = std::fabs(static_cast<double>(a) - static_cast<double>(b));
    total.largest =
        std::max(total.largest, std::isnan(distance) ? std::numeric_limits<double>::infinity() : distance);
}
inline void compare_values(Difference& total, const Vec3f& a, const Vec3f& b) {
    for (int c = 0; c < 3; ++c) compare_values(total, a[c], b[c]);
}

/// Adds the differences of two arrays. All values of the longer one differ if the lengths do.
template <class T, class Allocator>
void compare_arrays(Difference& total, const std::vector<T, Allocator>& a, const std::vector<T, Allocator>& b) {
    if (a.size() != b.size()) {
        const std::size_t longer = std::max(a.size(), b.size());
        total.values += longer;
        total.differing += longer;
        total.largest = std::numeric_limits<double>::infinity();
        return;
    }
    for (std::size_t i = 0; i < a.size(); ++i) compare_values(total, a[i], b[i]);
}

}  // namespace pl::parity
