// Runs of a bench dealt out over the ranks of a job, one by one.
#pragma once

#include <vector>

#include "core/bench/bench.h"
#include "mpi/communicator.h"

namespace pl {

/// On rank 0: makes the runs on all ranks, itself included, each on one rank with its own back ends and threads. Finished ones come
/// to `on_finished` as they arrive; host names are set. Returns false if it was stopped: only runs under way are lost. Throws the
/// first rank's error: Error(Input) if a rank cannot open the scenes, or has others.
bool deal_runs(Communicator& ranks, const bench::BenchPlan& plan, const std::vector<bench::PlannedRun>& runs,
               const StopFlag* stop, const bench::OnFinishedRun& on_finished);

}  // namespace pl
