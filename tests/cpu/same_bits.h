// Equality of vectors bit by bit, which keeps 0 and -0 apart and NaN equal to itself.
#pragma once

#include <cstring>

#include "core/kernel/base/math.h"

namespace pl::test {

inline bool same_bits(const Vec3f& a, const Vec3f& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

}  // namespace pl::test
