// What a kernel's thread knows of itself and its neighbours. On the host the same functions serve one thread after
// another: kernels hold no barrier and no shared memory, so they run there unchanged.
#pragma once

#include <cuda_runtime.h>

#include "core/kernel/base/atomics.h"
#include "core/kernel/integrator/path.h"

namespace pl::cuda {

__device__ inline std::uint32_t thread_number() { return blockIdx.x * blockDim.x + threadIdx.x; }

/// Takes the next number of a queue. The threads of a warp that ask together share one atomic and get neighbouring
/// numbers, so that their rays start out alike.
__device__ inline std::uint32_t claim(std::uint32_t& queue) {
#ifdef __CUDA_ARCH__
    const unsigned asking = __activemask();
    const unsigned lane = threadIdx.x % 32u;
    const int leader = __ffs(static_cast<int>(asking)) - 1;
    std::uint32_t first = 0;
    if (lane == static_cast<unsigned>(leader)) first = atomicAdd(&queue, static_cast<unsigned>(__popc(asking)));
    first = __shfl_sync(asking, first, leader);
    return first + static_cast<std::uint32_t>(__popc(asking & ((1u << lane) - 1u)));
#else
    return std::atomic_ref<std::uint32_t>(queue).fetch_add(1, std::memory_order_relaxed);
#endif
}

/// Adds to a sum of the whole launch. Called by every thread at its end; a warp adds up first, because a hundred
/// thousand atomics on one address would take longer than the paths.
__device__ inline void add_up(std::uint64_t& total, std::uint64_t value) {
#ifdef __CUDA_ARCH__
    for (int offset = 16; offset > 0; offset /= 2) value += __shfl_down_sync(0xffffffffu, value, offset);
    if (threadIdx.x % 32u == 0 && value != 0) atomicAdd(reinterpret_cast<unsigned long long*>(&total), value);
#else
    std::atomic_ref<std::uint64_t>(total).fetch_add(value, std::memory_order_relaxed);
#endif
}

/// Makes a maximum of the whole launch at least `value`. Called by every thread; a warp takes its own maximum first.
__device__ inline void raise_to(std::uint32_t& maximum, std::uint32_t value) {
#ifdef __CUDA_ARCH__
    for (int offset = 16; offset > 0; offset /= 2) value = max(value, __shfl_down_sync(0xffffffffu, value, offset));
    if (threadIdx.x % 32u == 0 && value != 0) atomicMax(&maximum, value);
#else
    const std::atomic_ref<std::uint32_t> shared(maximum);
    std::uint32_t seen = shared.load(std::memory_order_relaxed);
    while (seen < value && !shared.compare_exchange_weak(seen, value, std::memory_order_relaxed)) continue;
#endif
}

__device__ inline void add_up(PassCounters& totals, const PassCounters& counters) {
    add_counters(totals, counters, [](std::uint64_t& total, std::uint64_t count) { add_up(total, count); });
}

}  // namespace pl::cuda
