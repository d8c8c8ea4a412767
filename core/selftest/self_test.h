// The self test: scenes whose radiance has a closed form, rendered by a back end on this machine. Prints nothing: the command
// line and the viewer show its checks.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/session/backend.h"

namespace pl {

// One result of the self test, for display on a command line or in a window.

/// One scene, one way of rendering it, one value with its expected value.
struct SelfCheck {
    std::string backend;    ///< "cpu"
    std::string name;       ///< "lamp over a floor: reinforcement"
    std::string criterion;  ///< the condition, in words
    double expected = 0.0;
    double measured = 0.0;
    double tolerance = 0.0;   ///< largest difference of the two; 0: they have to be equal
    double used_share = 0.0;  ///< difference over tolerance; without tolerance 0 if the check passes, else infinite
    bool passed = false;
    double seconds = 0.0;
};

/// Runs every check on a back end that is in no other use; needs no files. Calls `told` after each check. Ends early,
/// with the checks done by then, when `stop` is raised. A statistical check passes only if its samples resolve an
/// error of the size named by its criterion, and fails by chance once in a million. Throws the exceptions of the back
/// end.
std::vector<SelfCheck> run_self_test(const std::shared_ptr<RenderBackend>& backend,
                                     const std::function<void(const SelfCheck&)>& told = {},
                                     const StopFlag* stop = nullptr);

/// The same on new back ends of these names, one after the other. Also throws the exceptions of `make`.
std::vector<SelfCheck> run_self_test(const std::vector<std::string>& backends, const BackendFactory& make,
                                     const std::function<void(const SelfCheck&)>& told = {},
                                     const StopFlag* stop = nullptr);

}  // namespace pl
