// Values at random, for functions that take arrays of any.
#pragma once

#include <vector>

#include "tests/support/scenes/shapes.h"

namespace pl::test {

/// Uniform in [low, high).
inline std::vector<float> random_values(std::size_t count, float low, float high, std::uint64_t seed) {
    Uniforms random(seed);
    std::vector<float> values(count);
    for (float& value : values) value = random.between(low, high);
    return values;
}

}  // namespace pl::test
