// The loop of every subcommand without a window: passes until a limit is reached or the run is interrupted.
#pragma once

#include <array>
#include <functional>

#include "app/console.h"
#include "app/state_files.h"
#include "core/base/choice.h"
#include "core/base/progress.h"
#include "core/measure/error_target.h"
#include "core/session/session.h"

namespace pl {

enum class Until {
    Rendered,  ///< a limit of the options is reached
    Learned,   ///< the same, but a complete precomputed map is enough
};

/// The option whose limit was reached, or another reason; nothing if there was no pass to render.
enum class EndedBy { Nothing, Spp, TimeLimit, TargetError, Learned, Interruption };

template <>
inline constexpr auto kChoices<EndedBy> = std::to_array<ChoiceInfo<EndedBy>>({
    {EndedBy::Nothing, "nothing", "nothing"},
    {EndedBy::Spp, "spp", "--spp"},
    {EndedBy::TimeLimit, "time-limit", "--time-limit"},
    {EndedBy::TargetError, "target-error", "--target-error"},
    {EndedBy::Learned, "learned", "learned"},
    {EndedBy::Interruption, "interruption", "interruption"},
});

struct RunOutcome {
    EndedBy ended_by = EndedBy::Nothing;
    double seconds = 0.0;  ///< wall clock of the loop, including the run that it resumes

    bool interrupted() const { return ended_by == EndedBy::Interruption; }
};

/// Tells the back end, the kernel and the size of the picture, to the log and as an event.
void announce(const Session& session, Console& console);

/// Observers of a run; each may be null.
struct RunAids {
    ErrorTarget* target = nullptr;                              ///< may end it
    CheckpointFiles* checkpoints = nullptr;                     ///< written along the way
    std::function<void(const ProgressState&)> show_progress{};  ///< after every piece of work
};

/// Makes at least one sample per pixel unless `stop` is raised, an interruption.
RunOutcome run_passes(Session& session, const Options& options, const StopFlag& stop, Console& console,
                      Until until = Until::Rendered, const RunAids& aids = {});

}  // namespace pl
