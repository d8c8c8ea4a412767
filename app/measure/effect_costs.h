// `pathlight bench --effects`: what it costs to be able to do what a scene does not ask for.
#pragma once

#include "app/console.h"
#include "app/measure/bench_plan.h"

namespace pl {

/// Measures, for every scene, back end and method of a plan, the kernel that the scene needs against every other compiled one that
/// could serve it. All do the same work to the bit, in turns, so that slow changes of the machine fall on all alike. Prints a
/// table and writes effects.json (schema "pathlight.effects/1") and effects.md into `folder`. `threads`: of CPU back ends, 0
/// for all. Returns the exit code.
int measure_effect_costs(const BenchPlan& plan, int threads, const std::filesystem::path& folder, Console& console);

}  // namespace pl
