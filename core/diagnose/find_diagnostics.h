// Locating the diagnostics of a picture: the pixels of the samples, paths and lookups that its passes counted.
#pragma once

#include <functional>

#include "core/diagnose/diagnostics.h"
#include "core/session/session.h"

namespace pl::diagnose {

/// The passes to search, and their counts.
struct DiagnosticsInput {
    PassReplay passes;
    DiagnosticCounts counted{};
};

/// Of the session's current picture. Throws Error(Usage) if its view shows no paths.
DiagnosticsInput diagnostics_input(const Session& session, FilmSlot slot);

/// Invalid samples come from the film; for the other kinds the passes are traced again, newest first, by
/// replay_path(). Ends when every counted occurrence is located (clamped training samples: after 16 samples per
/// pixel, since the field has changed too much before those), when all passes are traced, or when `stop` is raised.
/// Calls `told` with the share of passes traced. `threads` 0: all.
DiagnosticsMap find_diagnostics(DiagnosticsInput source, int threads, const StopFlag* stop = nullptr,
                                const std::function<void(double share)>& told = {});

}  // namespace pl::diagnose
