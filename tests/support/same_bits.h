// Equality bit by bit, which keeps 0 and -0 apart and NaN equal to itself.
#pragma once

#include <cstring>
#include <type_traits>
#include <vector>

namespace pl::test {

/// For types without padding.
template <class T>
requires std::is_trivially_copyable_v<T>
bool same_bits(const T& a, const T& b) { return std::memcmp(&a, &b, sizeof a) == 0; }
template <class T, class Allocator>
bool same_bits(const std::vector<T, Allocator>& a, const std::vector<T, Allocator>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

}  // namespace pl::test
