// The self test: scenes whose light is known, rendered by a back end on this machine and held against their closed
// forms. Prints nothing; the command line and a viewer may show what it finds.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/session/backend.h"
#include "core/session/self_check.h"

namespace pl {

/// Runs every check on a back end of its own; it needs no files. Calls `told` after each one. Ends early, with what is
/// done, when `stop` is raised. A statistical check passes only if its samples could have shown an error of the size
/// that its criterion names, and fails by chance once in a million. Throws what the back end throws.
std::vector<SelfCheck> run_self_test(const std::shared_ptr<RenderBackend>& backend,
                                     const std::function<void(const SelfCheck&)>& told = {},
                                     const StopFlag* stop = nullptr);

/// The same on new back ends of these names, one after the other. `threads` 0: all.
std::vector<SelfCheck> run_self_test(const std::vector<std::string>& backends, int threads,
                                     const std::function<void(const SelfCheck&)>& told = {},
                                     const StopFlag* stop = nullptr);

}  // namespace pl
