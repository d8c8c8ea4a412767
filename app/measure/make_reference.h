// Rendering a reference, half by half in turns, saved as it grows.
#pragma once

#include "app/console.h"
#include "app/interrupt.h"
#include "app/measure/reference_store.h"
#include "core/session/session.h"

namespace pl {

struct ReferenceOutcome {
    Reference reference;
    std::filesystem::path manifest;
    bool interrupted = false;
};

/// Goes on with what the store holds until both halves have `options.spp` samples per pixel or the time limit is over;
/// at least one sample is in each half then, unless interrupted. Little is lost by a crash, nothing by an interruption.
/// The session's seed is changed: each half, and each piece of work on it, has random numbers of its own.
ReferenceOutcome make_reference(Session& session, const Options& options, const ReferenceStore& store,
                                const InterruptGuard& interrupt, Console& console);

}  // namespace pl
