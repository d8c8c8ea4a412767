// --diagnostics FILE: the diagnostics of a picture as a picture and as JSON.
#pragma once

#include <filesystem>

#include "app/events.h"
#include "core/diagnose/diagnostics.h"
#include "core/io/image.h"
#include "core/session/settings.h"

namespace pl {

/// Counts of the passes, and their places: `found` is null without a search. Clamped training samples are null there
/// if tracing again does not repeat those of the passes.
Json diagnostics_json(const Snapshot& snapshot, const diagnose::DiagnosticsMap* found);

/// By suffix. .png: the picture, darkened, with marks in the colors of all_diagnostics(). .exr and .pfm: counts of each
/// pixel, red invalid samples, green escaped paths, blue lookup misses and clamped training samples.
void save_diagnostics(const std::filesystem::path& path, const Snapshot& snapshot, const DisplaySettings& display,
                      const diagnose::DiagnosticsMap& map, ImageMetadata metadata);

}  // namespace pl
