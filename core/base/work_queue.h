// Parallel work without OpenMP: a queue of index chunks, and threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "core/base/usable_threads.h"

namespace pl {

/// Carries the first exception of several threads, none of which may let one escape, to the caller.
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

/// Calls body(thread) for thread = 0 .. threads - 1 concurrently, waits for all, and rethrows the first exception.
template <class Body>
void run_on_plain_threads(int threads, Body&& body) {
    FirstException exception;
    std::vector<std::thread> others;
    for (int thread = 1; thread < threads; ++thread)
        others.emplace_back([&, thread] { exception.guard([&] { body(thread); }); });
    exception.guard([&] { body(0); });
    for (std::thread& other : others) other.join();
    exception.rethrow();
}

/// The indices [begin, end).
struct IndexRange {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;

    bool empty() const { return begin == end; }
};

/// Distributes the indices [first, end) in ascending chunks to any number of threads. No chunk is claimed after
/// `stop` is set; if claimed chunks are always completed, the completed indices are a prefix.
class ChunkQueue {
public:
    ChunkQueue(std::uint32_t first, std::uint32_t end, std::uint32_t chunk, const std::atomic<bool>* stop = nullptr)
        : next_(first), end_(end), chunk_(chunk), stop_(stop) {}

    /// The next chunk; empty at the end.
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

}  // namespace pl
