// The place of a picture that --output names: a file, whose suffix decides the kind, or standard output.
#pragma once

#include <string>

#include "app/console.h"
#include "core/io/image.h"
#include "core/io/json_file.h"
#include "core/session/session.h"
#include "core/session/settings.h"
#include "core/session/snapshot.h"

namespace pl {

/// "-", and with the kind in front "png:-", "exr:-" and "pfm:-".
bool is_standard_output(const std::string& output);

/// PNG for "-". Throws Error(Usage) for another suffix.
ImageKind picture_kind(const std::string& output);

/// Names the first fault before any work; from then on standard output is left to the picture, if it goes there. Throws Error(Usage)
/// for a kind that is not written, --json or a terminal beside standard output, and Error(Runtime) for a file that cannot be made.
void require_target(const std::string& output, Console& console);

/// save_picture(), also to standard output.
void write_picture(const std::string& output, const Snapshot& snapshot, const DisplaySettings& display,
                   const ImageMetadata& metadata, Console& console);

// The settings and statistics that pictures carry.

/// `stats` come from stats_json(), `command` repeats the picture in a shell.
ImageMetadata metadata_of(const Session& session, const Snapshot& snapshot, const Json& stats,
                          const std::string& command, bool interrupted);

}  // namespace pl
