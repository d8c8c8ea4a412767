// Clocks and metrics as JSON.
#pragma once

#include "core/io/json_file.h"
#include "core/measure/metrics.h"
#include "core/session/snapshot.h"

namespace pl::bench {

// Clocks as JSON: one list for all exports, with the names of Clocks.

/// Seconds by clock; `sums` come behind them.
Json clocks_json(const Clocks& clocks, const Json& sums);
/// `upload` may be missing and is 0 then. Throws Json::exception.
Clocks clocks_from(const Json& json);

// Metrics as JSON, with the constants of their definitions.

/// psnr_db is null for equal pictures, whose value is infinite.
Json metrics_json(const Metrics& metrics);

/// Definitions by name, which document the exports.
Json metric_definitions();

}  // namespace pl::bench
