// Metrics as JSON, with the constants of their definitions.
#pragma once

#include "core/io/json_file.h"
#include "core/measure/metrics.h"

namespace pl::bench {

/// psnr_db is null for equal pictures, whose value is infinite.
Json metrics_json(const Metrics& metrics);

/// Definitions by name, which document the exports.
Json metric_definitions();

}  // namespace pl::bench
