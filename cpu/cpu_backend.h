// The CPU back end: every thread advances a batch of paths, one vertex per step.
#pragma once

#include <cstdint>
#include <memory>

#include "core/session/backend.h"

namespace pl {

struct CpuSettings {
    int threads = 0;                   ///< 0: all hardware threads
    std::uint32_t batch_paths = 1024;  ///< paths in flight per thread; affects speed only, never results
};

/// Throws Error(Usage) if the number of threads or paths is out of range.
std::unique_ptr<RenderBackend> make_cpu_backend(const CpuSettings& settings = {});

}  // namespace pl
