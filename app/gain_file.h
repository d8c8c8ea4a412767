// --gain FILE: where in a picture its method gains or loses against default at equal time.
#pragma once

#include "app/console.h"
#include "app/interrupt.h"
#include "app/options.h"
#include "core/measure/gain.h"
#include "core/session/session.h"

namespace pl {

/// Throws Error(Usage) if --gain is given with a method that has none, or for a file of another kind than .json and .png.
void require_gain(const Options& options);

/// Renders `default` beside the finished picture, in the same session, until it has taken as much time, and writes the file: the gains as
/// JSON, or the picture with a mark for each tile. Returns false if it was interrupted, and writes nothing then.
bool write_gain(Session& session, const Snapshot& snapshot, const Options& options, const InterruptGuard& interrupt,
                Console& console);

}  // namespace pl
