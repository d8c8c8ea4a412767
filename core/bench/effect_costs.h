// The cost of generality: kernels that can serve a scene although they are compiled for more effects than it needs.
#pragma once

#include <functional>
#include <optional>

#include "core/bench/bench_plan.h"
#include "core/measure/statistics.h"
#include "core/session/backend.h"

namespace pl::bench {

/// One kernel on one scene, method and back end.
struct EffectCost {
    BenchCell cell;
    std::string kernel;
    std::vector<std::string> effects;  ///< that the kernel is compiled for
    bool is_needed = false;            ///< the kernel that serves the scene; the other ones are larger
    Interval ratio;                    ///< of its time to the time of the needed kernel
    double nanoseconds = 0.0;          ///< per segment, of the fastest turn

    /// "none", "mirrors, glass".
    std::string effects_text() const;
};

/// Measures, for every scene, back end and method of a plan, the kernel with the needed effects against every larger
/// one that covers them. All do the same work to the bit, in turns, so that slow changes of the machine affect all
/// alike; BenchPlan::seeds is the number of rounds. Each kernel gets a back end of its own from `make`. Calls `on_cost` with each.
/// Empty if `stop` was raised.
std::optional<std::vector<EffectCost>> measure_effect_costs(const BenchPlan& plan, const BackendFactory& make,
                                                            const StopFlag* stop,
                                                            const std::function<void(const EffectCost&)>& on_cost);

/// Writes effects.json (schema "pathlight.effects/1") and effects.md.
void write_effect_costs(const std::filesystem::path& folder, const std::vector<EffectCost>& costs);

}  // namespace pl::bench
