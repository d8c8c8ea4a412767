// Back ends in words.
#pragma once

#include <string>

#include "core/session/backend.h"

namespace pl {

/// "Xeon, 15 threads", and of a job ", 4 ranks"; without the threads where the back end has none.
std::string device_text(const BackendInfo& info);

}  // namespace pl
