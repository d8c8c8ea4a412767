// Making one run of a bench, wherever it is made.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "core/bench/bench_plan.h"

namespace pl::bench {

struct FinishedRun {
    BenchRun run;
    std::vector<LinearImage> pictures{};  ///< of the points of the first seed's run; else none
};

/// Makes a run from the beginning; empty if `stop` is raised before its end. `on_work` is called after each piece of work and may
/// be empty. Commit and host of the run are the caller's to set. The plan's scene needs its reference.
std::optional<FinishedRun> make_run(const BenchPlan& plan, const PlannedRun& planned, const StopFlag* stop,
                                    const std::function<void(const Session&, FilmSlot)>& on_work);

}  // namespace pl::bench
