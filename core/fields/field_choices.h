// What users read of the choices in the settings of a field. Apart from the enumerations, which kernels include.
#pragma once

#include <array>

#include "core/base/choice.h"
#include "core/fields/field_model.h"

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
inline constexpr auto kChoices<Representation> = kRepresentations;

}  // namespace pl
