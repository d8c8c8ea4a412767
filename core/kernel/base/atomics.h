// Integer atomic adds. The sums of training samples are integers because integer addition is associative: the result
// is the same for every thread count, order and back end.
#pragma once

#include <atomic>
#include <cstdint>

#include "core/kernel/base/platform.h"

namespace pl {

/// Number of threads that add to the same sums. A single host thread needs no atomic instruction, which costs several
/// times a plain add. Device code is always Many.
enum class Writers : std::uint32_t { Many, One };

#ifndef __CUDA_ARCH__
template <class T>
inline void add_on_host(T& target, T value, Writers writers) {
    if (writers == Writers::One)
        target += value;
    else
        std::atomic_ref<T>(target).fetch_add(value, std::memory_order_relaxed);
}
#endif

/// Relaxed: the sums are read after the pass has ended, which orders them.
PL_HD inline void atomic_add(std::int64_t& target, std::int64_t value, [[maybe_unused]] Writers writers) {
#ifdef __CUDA_ARCH__
    atomicAdd(reinterpret_cast<unsigned long long*>(&target), static_cast<unsigned long long>(value));
#else
    add_on_host(target, value, writers);
#endif
}

PL_HD inline void atomic_add(std::uint32_t& target, std::uint32_t value, [[maybe_unused]] Writers writers) {
#ifdef __CUDA_ARCH__
    atomicAdd(&target, value);
#else
    add_on_host(target, value, writers);
#endif
}

/// Stores a value where 0 is; every thread that stores to the same place must store the same value.
PL_HD inline void store_if_zero(std::uint8_t& target, std::uint8_t value) {
#ifdef __CUDA_ARCH__
    if (target == 0) target = value;
#else
    std::uint8_t zero = 0;
    std::atomic_ref<std::uint8_t>(target).compare_exchange_strong(zero, value, std::memory_order_relaxed);
#endif
}

/// Adds a value to a sum and 1 to its count. That threads of a warp with the same target add up their values first changes no time
/// (docs/notebook/2026-11-27-second-hour-on-a-gpu.md).
PL_HD inline void atomic_add_counted(std::int64_t& sum, std::int64_t value, std::uint32_t& count, Writers writers) {
    atomic_add(sum, value, writers);
    atomic_add(count, 1u, writers);
}

}  // namespace pl
