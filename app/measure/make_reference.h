// Rendering a reference, half by half in turns, saved as it grows.
#pragma once

#include <functional>
#include <optional>

#include "app/console.h"
#include "app/interrupt.h"
#include "app/measure/reference_store.h"
#include "app/progress.h"
#include "core/session/session.h"

namespace pl {

struct ReferenceOutcome {
    Reference reference;
    std::filesystem::path manifest;
    bool interrupted = false;
};

/// How long it goes on, and whom it tells.
struct ReferencePlan {
    std::string scene;              ///< as it was named, for the manifest
    std::uint32_t spp = 0;          ///< samples per pixel in each half
    std::optional<double> seconds;  ///< of this piece of work
    bool in_both_halves = false;    ///< even if stopped there is a sample in each half at the end
    std::function<bool()> stopped;
    std::function<void(const ProgressState&)> show;
};

/// Goes on with what the store holds until both halves have `plan.spp` samples per pixel or the time limit is over; at
/// least one sample is in each half then, unless stopped. Little is lost by a crash, nothing by an interruption. The
/// session's seed is changed: each half, and each piece of work on it, has random numbers of its own.
ReferenceOutcome make_reference(Session& session, const ReferencePlan& plan, const ReferenceStore& store);

/// The same as options say, with progress on the console.
ReferenceOutcome make_reference(Session& session, const Options& options, const ReferenceStore& store,
                                const InterruptGuard& interrupt, Console& console);

}  // namespace pl
