// What users read of the choices in the settings of a field. Apart from the enumerations, which kernels include.
#pragma once

#include <array>

#include "core/base/choice.h"
#include "core/fields/field_shape.h"

namespace pl {

template <>
inline constexpr auto kChoices<LearningRate> = std::to_array<ChoiceInfo<LearningRate>>({
    {LearningRate::SampleMean, "mean", "Mean", "1/(1+n) after n training samples, which all count alike"},
    {LearningRate::Forgetful, "forgetful", "Forgetful", "early training samples lose their weight"},
});

template <>
inline constexpr auto kChoices<LearningTarget> = std::to_array<ChoiceInfo<LearningTarget>>({
    {LearningTarget::ExpectedSarsa, "expected-sarsa", "Expected Sarsa",
     "the expected reflected radiance at the next vertex"},
    {LearningTarget::Sarsa, "sarsa", "Sarsa", "the learned radiance of the next direction, as sampled"},
    {LearningTarget::MonteCarlo, "monte-carlo", "Monte Carlo", "the radiance of the rest of the path"},
});

template <>
inline constexpr auto kChoices<LearnedLight> = std::to_array<ChoiceInfo<LearnedLight>>({
    {LearnedLight::All, "all", "All", "all incident radiance"},
    {LearnedLight::Indirect, "indirect", "Indirect", "only the part that light samples do not bring"},
});

template <>
inline constexpr auto kChoices<Representation> = std::to_array<ChoiceInfo<Representation>>({
    {Representation::Table, "table", "Table", "cells of directions in each radiance volume"},
    {Representation::SdTree, "sd-tree", "SD-tree",
     "quadtrees over directions at the leaves of a tree over space, on the CPU alone"},
    {Representation::Lobes, "lobes", "Lobes",
     "a mixture of von Mises-Fisher lobes in each radiance volume, on the CPU alone"},
    {Representation::Neural, "neural", "Neural", "a network that gives each vertex a mixture of lobes"},
});

}  // namespace pl
