// --diagnostics FILE: the diagnostics of a picture as a picture and as JSON.
#pragma once

#include "app/console.h"
#include "app/interrupt.h"
#include "app/options.h"
#include "core/io/image.h"
#include "core/session/session.h"

namespace pl {

/// Counts of the passes of a picture.
Json diagnostics_json(const Snapshot& snapshot);

/// Traces the paths of a picture again and writes their places. By suffix, .png: the picture, darkened, with marks in the colors of
/// all_diagnostics(). .exr and .pfm: counts of each pixel, red invalid samples, green escaped paths, blue lookup misses and clamped
/// training samples. An event has diagnostics_json() and the places as `found`; clamped training samples are null
/// there if tracing again does not repeat the clamped training samples of the passes. Returns false if it was
/// interrupted, and writes what was found until then.
bool write_diagnostics(const Session& session, const Snapshot& snapshot, const Options& options,
                       ImageMetadata metadata, const InterruptGuard& interrupt, Console& console);

}  // namespace pl
