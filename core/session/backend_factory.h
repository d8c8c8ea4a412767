// Back ends by name: the program implements this, sessions and tools call it.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "core/session/backend.h"

namespace pl {

/// Makes a back end by name: "cpu", "cuda". Throws Error(Unavailable) with the reason. May be called from any thread.
using BackendFactory = std::function<std::unique_ptr<RenderBackend>(const std::string& name)>;

}  // namespace pl
