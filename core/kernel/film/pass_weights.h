// The weights of passes in a film. The first passes of a learning method are sampled while its field knows little:
// their variance is many times the variance of later passes.
#pragma once

#include "core/kernel/base/math.h"

namespace pl {

/// Weights that grow linearly with the number of the pass. Fixed in advance: weights that depended on the samples would be a
/// bias. [Mueller et al. 2017, section 5.1, leave out the samples of early iterations instead]
struct PassWeights {
    std::uint32_t ramp = 1;  ///< passes until the weight is constant; 1: equal weights

    PL_HD std::uint32_t of(std::uint32_t pass) const { return pass < ramp ? pass + 1u : ramp; }
};

}  // namespace pl
