// All threading of this back end: a team of threads, and a queue from which they claim work. OpenMP where it is
// there; plain threads under the thread sanitizer, which cannot see into the OpenMP run-time library.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <exception>
#include <mutex>
#ifdef PL_TSAN
#include <thread>
#include <vector>
#else
#include <omp.h>
#endif

namespace pl {

/// Keeps the first exception of several threads, none of which may let one escape.
class FirstException {
public:
    template <class Body>
    void guard(Body&& body) noexcept {
        try {
            body();
        } catch (...) {
            const std::lock_guard lock(mutex_);
            if (!first_) first_ = std::current_exception();
        }
    }
    void rethrow() const {
        if (first_) std::rethrow_exception(first_);
    }

private:
    std::mutex mutex_;
    std::exception_ptr first_;
};

/// Calls body(thread) on up to `threads` threads at once, with thread < threads, waits for all, and rethrows the first
/// exception. The number may be smaller than asked for, so work is claimed, never divided.
template <class Body>
void run_on_threads(int threads, Body&& body) {
    FirstException exception;
#ifdef PL_TSAN
    std::vector<std::thread> others;
    for (int thread = 1; thread < threads; ++thread)
        others.emplace_back([&, thread] { exception.guard([&] { body(thread); }); });
    exception.guard([&] { body(0); });
    for (std::thread& other : others) other.join();
#else
#pragma omp parallel num_threads(threads)
    exception.guard([&] { body(omp_get_thread_num()); });
#endif
    exception.rethrow();
}

/// Threads that run at once on this machine.
inline int hardware_threads() {
#ifdef PL_TSAN
    return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
#else
    return omp_get_num_procs();
#endif
}

/// Numbers from `begin` up to, but not including, `end`.
struct IndexRange {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;

    bool empty() const { return begin == end; }
};

/// Hands out the numbers from `first` up to, but not including, `end`, in ascending chunks; any thread may ask. Once
/// `stop` is set nothing more is handed out, so if claimed chunks are always done, what is done is a prefix.
class ChunkQueue {
public:
    ChunkQueue(std::uint32_t first, std::uint32_t end, std::uint32_t chunk, const std::atomic<bool>* stop = nullptr)
        : next_(first), end_(end), chunk_(chunk), stop_(stop) {}

    /// The next chunk; empty when there is none.
    IndexRange claim() {
        if (stop_ != nullptr && stop_->load(std::memory_order_relaxed)) return {};
        const std::uint64_t begin = next_.fetch_add(chunk_, std::memory_order_relaxed);
        if (begin >= end_) return {};
        const std::uint64_t end = std::min(begin + chunk_, end_);
        return {static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)};
    }

private:
    std::atomic<std::uint64_t> next_;
    std::uint64_t end_;
    std::uint64_t chunk_;
    const std::atomic<bool>* stop_;
};

/// Calls body(range) for every chunk the queue hands out, in any order.
template <class Body>
void parallel_for(int threads, ChunkQueue& queue, Body&& body) {
    run_on_threads(threads, [&](int) {
        for (IndexRange range = queue.claim(); !range.empty(); range = queue.claim()) body(range);
    });
}

}  // namespace pl
