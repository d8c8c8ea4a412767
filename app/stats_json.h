// Counts and timings of a rendering as JSON, schema "pathlight.stats/1".
#pragma once

#include <string>

#include "app/events.h"
#include "app/option_values.h"
#include "app/run_passes.h"
#include "core/session/session.h"

namespace pl {

/// All members of `--stats`, in their order. `target` is null without one.
Json stats_json(const Session& session, const Snapshot& snapshot, const Options& options, const RunOutcome& outcome,
                const ErrorTarget* target = nullptr);

}  // namespace pl
