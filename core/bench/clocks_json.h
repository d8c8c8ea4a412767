// Clocks as JSON: one list for all exports, whose names are those of Clocks.
#pragma once

#include "core/io/json_file.h"
#include "core/session/snapshot.h"

namespace pl::bench {

/// Seconds by clock; `sums` come behind them.
Json clocks_json(const Clocks& clocks, const Json& sums);
/// `upload` may be missing and is 0 then. Throws Json::exception.
Clocks clocks_from(const Json& json);

}  // namespace pl::bench
