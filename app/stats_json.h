// Counts and timings of a rendering as JSON, schema "pathlight.stats/1".
#pragma once

#include <string>

#include "app/events.h"
#include "app/option_values.h"
#include "app/run_passes.h"
#include "core/session/session.h"

namespace pl {

/// Seconds by clock; `sums` come behind them. One list for all exports, whose names are those of Clocks.
Json clocks_json(const Clocks& clocks, const Json& sums);
/// Clocks that an earlier version did not have are 0. Throws what Json throws.
Clocks clocks_from(const Json& json);

/// Everything that `--stats` promises, in its order. `target` is null without one.
Json stats_json(const Session& session, const Snapshot& snapshot, const Options& options, const RunOutcome& outcome,
                const ErrorTarget* target = nullptr);

}  // namespace pl
