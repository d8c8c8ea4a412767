// Integer atomic adds. Learned tables are summed as integers, because integer addition commutes:
// the result is the same for every thread count, order and back end.
#pragma once

#include <atomic>
#include <cstdint>

#include "core/kernel/base/platform.h"

namespace pl {

/// Readers see these sums only after the pass has ended, so no ordering is needed.
PL_HD inline void atomic_add(std::int64_t& target, std::int64_t value) {
#ifdef __CUDA_ARCH__
    atomicAdd(reinterpret_cast<unsigned long long*>(&target), static_cast<unsigned long long>(value));
#else
    std::atomic_ref<std::int64_t>(target).fetch_add(value, std::memory_order_relaxed);
#endif
}

PL_HD inline void atomic_add(std::uint32_t& target, std::uint32_t value) {
#ifdef __CUDA_ARCH__
    atomicAdd(&target, value);
#else
    std::atomic_ref<std::uint32_t>(target).fetch_add(value, std::memory_order_relaxed);
#endif
}

/// Adds a value to a sum and one to its count. On a device the threads of a warp that hit the same sum add up first:
/// paths that start side by side meet the same volume and are guided into the same few cells.
PL_HD inline void atomic_add_counted(std::int64_t& sum, std::int64_t value, std::uint32_t& count) {
#ifdef __CUDA_ARCH__
    const unsigned peers = __match_any_sync(__activemask(), reinterpret_cast<unsigned long long>(&sum));
    std::int64_t total = 0;
    for (unsigned rest = peers; rest != 0; rest &= rest - 1)
        total += __shfl_sync(peers, static_cast<long long>(value), __ffs(static_cast<int>(rest)) - 1);
    if (static_cast<int>(threadIdx.x % 32u) != __ffs(static_cast<int>(peers)) - 1) return;
    atomic_add(sum, total);
    atomic_add(count, static_cast<std::uint32_t>(__popc(peers)));
#else
    atomic_add(sum, value);
    atomic_add(count, 1u);
#endif
}

}  // namespace pl
