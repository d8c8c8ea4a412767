// What reinforcement learns from: which target a record holds, and which light counts.
#pragma once

#include <cstdint>

#include "core/kernel/base/features.h"

namespace pl {

/// The target of the record for leaving x through a cell, when the ray meets y.   [Sutton and Barto 2018, 5.1, 6.4, 6.6]
enum class LearningTarget : std::uint32_t {
    ExpectedSarsa,  ///< L_e(y) + the mean over the next direction of what y reflects   [Dahm and Keller 2017, section 3]
    Sarsa,          ///< L_e(y) + what y reflects of the next direction w that was drawn: f cos / pdf * Q(y, w)
    MonteCarlo,     ///< the light that the path really brought from there
};

/// Which light a record holds where lights are sampled; the same without.
enum class LearnedLight : std::uint32_t {
    All,       ///< all that arrives through the cell
    Indirect,  ///< what light samples at x do not bring: emission at y only as far as directions share in it
};

struct LearningSettings {
    LearningTarget target = LearningTarget::ExpectedSarsa;
    LearnedLight light = LearnedLight::All;

    friend bool operator==(const LearningSettings&, const LearningSettings&) = default;
};

/// The kernels that serve: records of the default need the least of a path.
enum class LearningKernel : std::uint32_t { Immediate, Late, WholePath };

/// Which sets of effects they are compiled for.
constexpr KernelRange range_of(LearningKernel kernel) {
    return kernel == LearningKernel::Immediate ? KernelRange::Full : KernelRange::Sparse;
}

constexpr LearningKernel kernel_for(const LearningSettings& learning, bool samples_lights) {
    if (learning.target == LearningTarget::MonteCarlo) return LearningKernel::WholePath;
    const bool late =
        learning.target == LearningTarget::Sarsa || (learning.light == LearnedLight::Indirect && samples_lights);
    return late ? LearningKernel::Late : LearningKernel::Immediate;
}

}  // namespace pl
