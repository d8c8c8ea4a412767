// The CPU back end: batches of paths, advanced step by step by a team of threads.
#pragma once

#include <cstdint>
#include <memory>

#include "core/session/backend.h"

namespace pl {

/// How rays find triangles. Auto: Dense up to 64 triangles, else Embree where the build has it, else Bvh.
enum class IntersectorChoice { Auto, Dense, Bvh, Embree };

struct CpuSettings {
    int threads = 0;  ///< 0: as many as the machine has
    IntersectorChoice intersector = IntersectorChoice::Auto;
    std::uint32_t batch_paths = 1024;  ///< paths that a thread keeps under way; decides speed, never results
};

/// Throws Error(Usage) for a number of threads or paths that makes no sense.
std::unique_ptr<RenderBackend> make_cpu_backend(const CpuSettings& settings = {});

}  // namespace pl
