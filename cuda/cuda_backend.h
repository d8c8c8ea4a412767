// The CUDA back end: the steps of the CPU back end, one path per device thread.
#pragma once

#include <memory>

#include "core/session/backend.h"

namespace pl {

/// Uses the first device (see CUDA_VISIBLE_DEVICES). Throws Error(Unavailable), with the reason, if there is none or
/// this build does not support it. Later errors (out of memory, device lost, failed kernel) are Error(Unavailable),
/// too; except after a failed allocation, the back end must then be destroyed.
std::unique_ptr<RenderBackend> make_cuda_backend();

}  // namespace pl
