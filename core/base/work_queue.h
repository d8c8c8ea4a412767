// Work that several threads share: a queue from which they claim it, and plain threads that do.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

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

/// Calls body(thread) on `threads` plain threads at once, with thread < threads, waits for all, and rethrows the first
/// exception.
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

}  // namespace pl
