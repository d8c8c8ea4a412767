// The CUDA back end: the same steps as on the CPU, run by thousands of threads.
#pragma once

#include <memory>

#include "core/session/backend.h"

namespace pl {

/// On the first device (CUDA_VISIBLE_DEVICES chooses). Throws Error(Unavailable) with the reason if there is none that
/// this build can use. Later errors (memory used up, device lost, a kernel that failed) are Error(Unavailable) too; the
/// back end is then only good for being destroyed, except after a failed allocation.
std::unique_ptr<RenderBackend> make_cuda_backend();

}  // namespace pl
