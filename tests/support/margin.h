// The share of their tolerances that tests use: a column of the table of hard cases, tests/hard.
#pragma once

#include <cmath>
#include <ostream>

namespace pl::test {

/// Set by tests/support/margins.cpp in Catch2 programs; elsewhere nobody asks.
inline void (*on_used_share)(double share) = nullptr;

/// Notes that the running test used this share of a tolerance; the largest one counts. Beyond 1 it should have failed.
inline void note_used_share(double share) {
    if (on_used_share != nullptr) on_used_share(share);
}

/// A number that must not exceed a limit.
struct Bounded {
    double value;
    double limit;

    explicit operator bool() const { return value <= limit; }  // NaN fails
};

inline std::ostream& operator<<(std::ostream& out, const Bounded& bounded) {
    return out << bounded.value << " of at most " << bounded.limit;
}

/// For CHECK: the size of `value` is at most `limit`, and its share of it is noted.
inline Bounded within(double value, double limit) {
    const double size = std::fabs(value);
    note_used_share(size == 0.0 ? 0.0 : size / limit);
    return {size, limit};
}

}  // namespace pl::test
