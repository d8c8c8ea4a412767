// From a back end's name to a back end.
#pragma once

#include <memory>
#include <string>

#include "core/session/backend.h"

namespace pl {

/// "auto" takes the best one there is, "cpu" and "cuda" insist. `threads` 0: all. Throws Error(Unavailable) with the
/// reason.
std::unique_ptr<RenderBackend> make_backend(const std::string& name, int threads);

}  // namespace pl
