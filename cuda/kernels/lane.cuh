// Thread index, and operations across a warp. On the host the same functions run for one thread at a time: kernels
// use no barriers and no shared memory but in stage() (scene_intersector.cuh), so they run there unchanged.
#pragma once

#include <cuda_runtime.h>

#include "core/kernel/base/atomics.h"
#include "core/kernel/integrator/path.h"

namespace pl::cuda {

__device__ inline std::uint32_t thread_number() { return blockIdx.x * blockDim.x + threadIdx.x; }

/// Threads of a warp, which run in step between the functions below; the host has warps of one.
#ifdef __CUDA_ARCH__
inline constexpr std::uint32_t kWarpLanes = 32;
__device__ inline std::uint32_t lane_number() { return threadIdx.x % kWarpLanes; }
/// A bit for each lane in which the condition holds. All lanes must call it.
__device__ inline std::uint32_t lanes_where(bool condition) { return __ballot_sync(0xffffffffu, condition); }
/// How many of the lanes of lanes_where() are before this one.
__device__ inline std::uint32_t lanes_before(std::uint32_t lanes) {
    return static_cast<std::uint32_t>(__popc(lanes & ((1u << lane_number()) - 1u)));
}
/// All lanes must call it: what they have written to shared memory is then read by any of them.
__device__ inline void wait_for_lanes() { __syncwarp(); }
/// The value that a lane has. All lanes must call it, for the same lane.
__device__ inline std::uint32_t of_lane(std::uint32_t value, std::uint32_t lane) {
    return __shfl_sync(0xffffffffu, value, static_cast<int>(lane));
}
__device__ inline float of_lane(float value, std::uint32_t lane) {
    return __shfl_sync(0xffffffffu, value, static_cast<int>(lane));
}
#else
inline constexpr std::uint32_t kWarpLanes = 1;
inline std::uint32_t lane_number() { return 0; }
inline std::uint32_t lanes_where(bool condition) { return condition ? 1u : 0u; }
inline std::uint32_t lanes_before(std::uint32_t) { return 0; }
inline void wait_for_lanes() {}
template <class Value>
inline Value of_lane(Value value, std::uint32_t) {
    return value;
}
#endif
__device__ inline Vec3f of_lane(Vec3f value, std::uint32_t lane) {
    return {of_lane(value.x, lane), of_lane(value.y, lane), of_lane(value.z, lane)};
}

/// Claims the next number of a queue. The active threads of a warp share one atomic addition and receive consecutive
/// numbers, so that their camera rays are coherent.
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

/// Adds to a sum over the whole launch. Every thread must call it, at its end. Sums over the warp first, because 1e5
/// atomic additions to one address would take longer than the paths.
__device__ inline void add_up(std::uint64_t& total, std::uint64_t value) {
#ifdef __CUDA_ARCH__
    for (int offset = 16; offset > 0; offset /= 2) value += __shfl_down_sync(0xffffffffu, value, offset);
    if (threadIdx.x % 32u == 0 && value != 0) atomicAdd(reinterpret_cast<unsigned long long*>(&total), value);
#else
    std::atomic_ref<std::uint64_t>(total).fetch_add(value, std::memory_order_relaxed);
#endif
}

/// Raises a maximum over the whole launch to at least `value`. Every thread must call it. Warps reduce first.
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

/// Barriers by which all threads of a block begin each step of a segment together: the instructions of a segment
/// exceed the instruction caches, the instructions of a step do not. `kSteps`: 0, no barriers; 1, the segment is one
/// step; 2, the path's ray, and shading; from 3 on, the shadow ray; from 4 on, scattering; 5, the light sample with
/// the roulette.
template <int kSteps>
struct StepOfBlock {
    /// Begins step 1. Whether a condition holds in any thread of the block; without barriers, in this one. All threads must call it.
    static __device__ bool any(bool condition) {
#ifdef __CUDA_ARCH__
        if constexpr (kSteps > 0) return __syncthreads_or(condition) != 0;
#endif
        return condition;
    }
    /// Begins a step that there is if a segment has at least `kLeast` of them. All threads must call it.
    template <int kLeast>
    static __device__ void begin() {
#ifdef __CUDA_ARCH__
        if constexpr (kSteps >= kLeast) __syncthreads();
#endif
    }
};

template <class Count>
__device__ inline void add_up(PassCounters& totals, const PassCountersOf<Count>& counters) {
    add_counters(totals, counters, [](std::uint64_t& total, std::uint64_t count) { add_up(total, count); });
}

}  // namespace pl::cuda
