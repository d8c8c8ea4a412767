// The CPU back end: every thread advances a batch of paths, one vertex per step.
#pragma once

#include <cstdint>
#include <memory>

#include "core/session/backend.h"

namespace pl {

/// Intersection algorithm. Auto: Dense up to 64 triangles, else Wide. Bvh serves as a peer in tests and benchmarks.
enum class IntersectorChoice { Auto, Dense, Wide, Bvh };

struct CpuSettings {
    int threads = 0;  ///< 0: all hardware threads
    IntersectorChoice intersector = IntersectorChoice::Auto;
    std::uint32_t batch_paths = 1024;  ///< paths in flight per thread; affects speed only, never results
};

/// Throws Error(Usage) if the number of threads or paths is out of range.
std::unique_ptr<RenderBackend> make_cpu_backend(const CpuSettings& settings = {});

}  // namespace pl
