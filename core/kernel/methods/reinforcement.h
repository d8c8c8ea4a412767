// Reinforcement path tracing: the paths of the picture train the field that guides the next ones.
// [Dahm and Keller 2017, "Learning Light Transport the Reinforced Way"]
#pragma once

#include "core/kernel/methods/method_info.h"
#include "core/kernel/methods/targets/expected_sarsa.h"
#include "core/kernel/methods/targets/monte_carlo.h"
#include "core/kernel/methods/targets/sarsa.h"

namespace pl {

struct Reinforcement {
    static constexpr MethodInfo kInfo{
        .name = "reinforcement",
        .label = "Reinforcement",
        .summary = "Directions guided by what the same paths have learned so far (Expected Sarsa).",
        .key = '3',
        .color = 0xff26c48fu,
        .uses_field = true,
        .learns = true};
};

}  // namespace pl
