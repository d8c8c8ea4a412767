// The self test: scenes whose light is known, rendered by a back end on this machine and held against their closed
// forms. Prints nothing; the command line and a viewer may show what it finds.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/session/backend.h"

namespace pl {

/// One scene, one way to render it, one number that has to come out.
struct SelfCheck {
    std::string name;       ///< "lamp over a floor: reinforcement"
    std::string criterion;  ///< what has to hold, in words
    double expected = 0.0;
    double measured = 0.0;
    double tolerance = 0.0;   ///< how far the two may be apart; 0: they have to be equal
    double used_share = 0.0;  ///< of the tolerance; of checks without tolerance 0 if they hold, else infinite
    bool passed = false;
    double seconds = 0.0;
};

/// Runs every check on a back end of its own; it needs no files. Calls `told` after each one. Ends early, with what is
/// done, when `stop` is raised. A statistical check passes only if its samples could have shown an error of the size
/// that its criterion names, and fails by chance once in a million. Throws what the back end throws.
std::vector<SelfCheck> run_self_test(const std::shared_ptr<RenderBackend>& backend,
                                     const std::function<void(const SelfCheck&)>& told = {},
                                     const StopFlag* stop = nullptr);

}  // namespace pl
