// The training target of the method reinforcement, and the part of incident radiance that it includes.
#pragma once

#include <cstdint>

#include "core/kernel/base/features.h"

namespace pl {

/// The target of the training sample for scattering from x through a cell, if the ray hits y.   [Sutton and Barto
/// 2018, 5.1, 6.4, 6.6]
enum class LearningTarget : std::uint32_t {
    ExpectedSarsa,  ///< L_e(y) + the expectation over the next direction of y's reflected radiance   [Dahm and Keller 2017, section 3]
    Sarsa,       ///< L_e(y) + the reflected radiance of the sampled next direction w: f cos / pdf * Q(y, w)
    MonteCarlo,  ///< the radiance from y of the rest of the path
};

/// The part of incident radiance in a target if lights are sampled; without light samples both are the same.
enum class LearnedLight : std::uint32_t {
    All,       ///< all radiance incident through the cell
    Indirect,  ///< without the light samples of x: emission at y has the MIS weight of scattered directions
};

struct LearningSettings {
    LearningTarget target = LearningTarget::ExpectedSarsa;
    LearnedLight light = LearnedLight::Indirect;

    friend bool operator==(const LearningSettings&, const LearningSettings&) = default;
};

}  // namespace pl
