// The loop of every subcommand without a window: passes until a limit is met or a person interrupts.
#pragma once

#include "app/console.h"
#include "app/interrupt.h"
#include "core/session/session.h"

namespace pl {

enum class Until {
    Rendered,  ///< the limits of the options are met
    Learned,   ///< the same, but a precomputed map is enough
};

struct RunOutcome {
    bool interrupted = false;
    double seconds = 0.0;  ///< wall clock of the loop
};

/// Makes at least one sample per pixel unless interrupted.
RunOutcome run_passes(Session& session, const Options& options, const InterruptGuard& interrupt, Console& console,
                      Until until = Until::Rendered);

}  // namespace pl
