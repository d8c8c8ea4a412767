// From a back end's name to a back end. The program knows all of them; those who ask for one know its name.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "core/session/backend.h"

namespace pl {

/// Makes a back end by name: "cpu", "cuda". Throws Error(Unavailable) with the reason. May be called from any thread.
using BackendFactory = std::function<std::unique_ptr<RenderBackend>(const std::string& name)>;

}  // namespace pl
