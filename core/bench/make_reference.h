// Rendering a reference: both halves in turns, saved as they grow.
#pragma once

#include <functional>
#include <optional>

#include "core/base/progress.h"
#include "core/bench/reference_store.h"
#include "core/session/session.h"

namespace pl::bench {

struct ReferenceOutcome {
    Reference reference;
    std::filesystem::path manifest;
    bool interrupted = false;
};

struct ReferencePlan {
    std::string scene;              ///< as its user names it, for the manifest
    std::uint32_t spp = 0;          ///< samples per pixel in each half
    std::optional<double> seconds;  ///< limit of this call
    bool in_both_halves = false;    ///< `stop` waits until each half has a sample
    const StopFlag* stop = nullptr;
    std::function<void(const ProgressState&)> show{};  ///< after each pass; may be empty
};

/// Continues the reference that the store holds until both halves have `plan.spp` samples per pixel or the time limit is
/// over, with at least one sample in each half unless stopped. A crash loses at most the last ten seconds, an interruption
/// nothing. Changes the session's seed: each half, and each stretch of passes, has random numbers of its own.
ReferenceOutcome make_reference(Session& session, const ReferencePlan& plan, const ReferenceStore& store);

}  // namespace pl::bench
