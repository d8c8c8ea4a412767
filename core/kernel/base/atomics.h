// Integer atomic adds. The sums of training samples are integers because integer addition is associative: the result
// is the same for every thread count, order and back end.
#pragma once

#include <atomic>
#include <cstdint>

#include "core/kernel/base/platform.h"

/// Whether threads of a warp on a device add up their training samples for the same cell before they add to it. Set by the option
/// of this name of the build, so that a device can decide.
#ifndef PL_CUDA_AGGREGATE_ATOMICS
#define PL_CUDA_AGGREGATE_ATOMICS 1
#endif

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

/// Adds a value to a sum and 1 to its count. On the device the threads of a warp with the same target may reduce their
/// values first: neighboring paths meet the same volume and are guided into the same few cells.
PL_HD inline void atomic_add_counted(std::int64_t& sum, std::int64_t value, std::uint32_t& count, Writers writers) {
#if defined(__CUDA_ARCH__) && PL_CUDA_AGGREGATE_ATOMICS
    const unsigned peers = __match_any_sync(__activemask(), reinterpret_cast<unsigned long long>(&sum));
    std::int64_t total = 0;
    for (unsigned rest = peers; rest != 0; rest &= rest - 1)
        total += __shfl_sync(peers, static_cast<long long>(value), __ffs(static_cast<int>(rest)) - 1);
    if (static_cast<int>(threadIdx.x % 32u) != __ffs(static_cast<int>(peers)) - 1) return;
    atomic_add(sum, total, writers);
    atomic_add(count, static_cast<std::uint32_t>(__popc(peers)), writers);
#else
    atomic_add(sum, value, writers);
    atomic_add(count, 1u, writers);
#endif
}

}  // namespace pl
