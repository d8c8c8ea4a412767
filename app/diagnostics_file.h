// What went wrong in a picture, as a picture and as JSON.
#pragma once

#include <filesystem>

#include "app/events.h"
#include "core/io/image.h"
#include "core/session/diagnostics.h"
#include "core/session/settings.h"

namespace pl {

/// What the passes counted, and where it was: `found` is null if nobody looked, its clamped records are null where tracing again meets none.
Json diagnostics_json(const Snapshot& snapshot, const DiagnosticsMap* found);

/// By suffix. .png: the picture, dark, with marks in the colors of all_diagnostics(). .exr and .pfm: red counts invalid samples,
/// green escaped paths, blue lookup misses and clamped records of each pixel.
void save_diagnostics(const std::filesystem::path& path, const Snapshot& snapshot, const DisplaySettings& display,
                      const DiagnosticsMap& map, ImageMetadata metadata);

}  // namespace pl
