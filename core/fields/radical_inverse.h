// The van der Corput sequence in base 2.
#pragma once

#include "core/kernel/base/rng.h"
#include "core/kernel/base/sobol.h"

namespace pl {

/// Bits of `index` mirrored behind the binary point, in [0, 1).   [van der Corput 1935]
inline float radical_inverse(std::uint32_t index) { return to_unit_float(reversed_bits(index)); }

}  // namespace pl
