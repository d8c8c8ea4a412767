// Counts and timings of a rendering as JSON, schema "pathlight.stats/1".
#pragma once

#include <string>

#include "app/events.h"
#include "app/option_values.h"
#include "core/session/session.h"

namespace pl {

/// Everything that `--stats` promises, in its order.
Json stats_json(const Session& session, const Snapshot& snapshot, const Options& options);

}  // namespace pl
