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

}  // namespace pl
