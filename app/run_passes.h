// The loop of every subcommand without a window: passes until a limit is met or a person interrupts.
#pragma once

#include "app/console.h"
#include "app/interrupt.h"
#include "app/measure/error_target.h"
#include "core/session/session.h"

namespace pl {

enum class Until {
    Rendered,  ///< the limits of the options are met
    Learned,   ///< the same, but a precomputed map is enough
};

enum class EndedBy { Nothing, Spp, TimeLimit, TargetError, Learned, Interruption };

/// "spp", "time-limit", "target-error": the option that it is the limit of; "learned", "interruption"; "nothing" if there
/// was nothing to do.
std::string_view name_of(EndedBy end);

struct RunOutcome {
    EndedBy ended_by = EndedBy::Nothing;
    double seconds = 0.0;  ///< wall clock of the loop

    bool interrupted() const { return ended_by == EndedBy::Interruption; }
};

/// Makes at least one sample per pixel unless interrupted. `target` may be null.
RunOutcome run_passes(Session& session, const Options& options, const InterruptGuard& interrupt, Console& console,
                      Until until = Until::Rendered, ErrorTarget* target = nullptr);

}  // namespace pl
