// From a back end's name to a back end.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/session/backend.h"

namespace pl {

/// "auto" takes CUDA if it is available, else the CPU; "cpu" and "cuda" insist. `threads` 0: all. Throws
/// Error(Unavailable) with the reason.
std::unique_ptr<RenderBackend> make_backend(const std::string& name, int threads);

/// Names of the back ends that make_backend() can make on this machine.
std::vector<std::string> available_backends();

}  // namespace pl
