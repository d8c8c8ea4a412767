// Targets, learning rates and rules of roulette other than the defaults.
#pragma once

#include "core/session/settings.h"

namespace pl::test {

struct Variant {
    const char* name;
    bool next_event;
    LearningRate rate = LearningRate::Forgetful;
    LearningSettings learning{};
    RouletteRule roulette = RouletteRule::Spare;
    Representation representation = Representation::Table;

    RenderSettings of(RenderSettings settings) const {
        settings.field.rate = rate;
        settings.field.learning = learning;
        settings.roulette = roulette;
        settings.field.representation = representation;
        return settings;
    }
};

inline constexpr Variant kVariants[] = {
    {"rate mean", false, LearningRate::SampleMean},
    {"Sarsa", false, LearningRate::Forgetful, {LearningTarget::Sarsa, LearnedLight::All}},
    {"Monte Carlo", false, LearningRate::Forgetful, {LearningTarget::MonteCarlo, LearnedLight::All}},
    {"Sarsa, light samples", true, LearningRate::Forgetful, {LearningTarget::Sarsa, LearnedLight::All}},
    {"Monte Carlo, light samples", true, LearningRate::Forgetful, {LearningTarget::MonteCarlo, LearnedLight::All}},
    {"Expected Sarsa, all light", true, LearningRate::Forgetful, {LearningTarget::ExpectedSarsa, LearnedLight::All}},
    {"Sarsa, indirect", true, LearningRate::Forgetful, {LearningTarget::Sarsa, LearnedLight::Indirect}},
    {"Monte Carlo, indirect", true, LearningRate::Forgetful, {LearningTarget::MonteCarlo, LearnedLight::Indirect}},
    {"roulette by albedo", false, LearningRate::Forgetful, {}, RouletteRule::Albedo},
    {"SD-tree", false, LearningRate::Forgetful, {}, RouletteRule::Spare, Representation::SdTree},
    {"SD-tree, light samples", true, LearningRate::Forgetful, {}, RouletteRule::Spare, Representation::SdTree},
    {"lobes", false, LearningRate::Forgetful, {}, RouletteRule::Spare, Representation::Lobes},
    {"lobes, light samples", true, LearningRate::Forgetful, {}, RouletteRule::Spare, Representation::Lobes},
    {"neural", false, LearningRate::Forgetful, {}, RouletteRule::Spare, Representation::Neural},
    {"neural, light samples", true, LearningRate::Forgetful, {}, RouletteRule::Spare, Representation::Neural},
};

}  // namespace pl::test
