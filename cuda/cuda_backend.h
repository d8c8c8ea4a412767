// The CUDA back end: the steps of the CPU back end, one path per device thread.
#pragma once

#include <memory>

#include "core/session/backend.h"

namespace pl {

struct CudaOptions {
    /// Most segments of a thread in one launch, see PathLauncher: at some microseconds each, tens of milliseconds.
    std::uint32_t most_segments = 4096;
};

/// Uses the first device (see CUDA_VISIBLE_DEVICES) and creates its context, which takes up to a second. Throws
/// Error(Unavailable), with the reason, if there is none, this build has no code for it, or a fault has ended its use by the
/// program. Later errors (out of memory, device lost, failed kernel) are Error(Unavailable), too; except after a failed
/// allocation, the back end must then be destroyed.
std::unique_ptr<RenderBackend> make_cuda_backend(const CudaOptions& options = {});

}  // namespace pl
