// Metrics as JSON, with the constants of their definitions.
#pragma once

#include "app/events.h"
#include "core/measure/metrics.h"

namespace pl {

/// What is not finite becomes null: psnr_db of equal pictures.
Json metrics_json(const Metrics& metrics);

/// The definitions in words, by name, for people who read exports.
Json metric_definitions();

}  // namespace pl
