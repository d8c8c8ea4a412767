// From a back end's name to a back end.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/session/backend.h"

namespace pl {

/// "auto" takes the best one there is, "cpu" and "cuda" insist. `threads` 0: all. Throws Error(Unavailable) with the
/// reason.
std::unique_ptr<RenderBackend> make_backend(const std::string& name, int threads);

/// Names of the back ends that make_backend() can make here.
std::vector<std::string> available_backends();

}  // namespace pl
