// The settings and statistics that pictures carry.
#pragma once

#include <string>

#include "core/io/image.h"
#include "core/io/json_file.h"
#include "core/session/session.h"

namespace pl {

/// `stats` are those of stats_json(), `command` repeats the picture in a shell.
ImageMetadata metadata_of(const Session& session, const Snapshot& snapshot, const Json& stats,
                          const std::string& command, bool interrupted);

}  // namespace pl
