// Work shared by threads: how many there are, chunks of a range, a queue, and tasks that find more tasks.
#pragma once

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <mutex>
#include <optional>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

namespace pl {

// The number of threads that run at once here: processors that this process may use, within the quota of its control group.

/// At least 1. A container may see all processors of its machine and have the time of a few: further threads would wait for one another.
int usable_threads();

/// Processors by the file cpu.max of a control group, rounded up: "QUOTA PERIOD", in microseconds. None without a limit, "max PERIOD",
/// and for other text.
std::optional<int> processors_of_quota(std::string_view text);

// Parallel work without OpenMP: a queue of index chunks, and threads.

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

    std::uint32_t count() const { return end - begin; }
    bool empty() const { return begin >= end; }
    friend bool operator==(const IndexRange&, const IndexRange&) = default;
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

// Loops whose chunks are run by several threads, and sums that are the same to the bit for any number of them.

/// Triangles or vertices that make a chunk worth a claim.
inline constexpr std::uint32_t kElementChunk = 8192;

/// Calls body(range) for every chunk of the indices [0, count), in any order, on up to `threads` threads.
template <class Body>
void for_chunks(std::uint32_t count, std::uint32_t chunk, int threads, Body&& body) {
    const std::uint64_t chunks = (std::uint64_t{count} + chunk - 1) / chunk;
    ChunkQueue queue(0, count, chunk);
    run_on_plain_threads(static_cast<int>(std::min<std::uint64_t>(chunks, static_cast<std::uint64_t>(threads))),
                         [&](int) {
                             for (IndexRange range = queue.claim(); !range.empty(); range = queue.claim())
                                 body(range);
                         });
}

/// Calls body(i) for the indices below `count`, by chunks of kElementChunk.
template <class Body>
void for_indices(std::uint32_t count, int threads, Body&& body) {
    for_chunks(count, kElementChunk, threads, [&](IndexRange range) {
        for (std::uint32_t i = range.begin; i < range.end; ++i) body(i);
    });
}

/// Calls body(sums, range) for consecutive ranges of `chunk` numbers below `count`, each with Sums of its own, copied
/// from `empty`; returns them in the order of the ranges, so that adding them up does not depend on `threads`.
template <class Sums, class Body>
std::vector<Sums> sums_of_chunks(std::size_t count, std::uint32_t chunk, int threads, const Sums& empty,
                                 Body&& body) {
    std::vector<Sums> sums((count + chunk - 1) / chunk, empty);
    for_chunks(static_cast<std::uint32_t>(count), chunk, threads,
               [&](IndexRange range) { body(sums[range.begin / chunk], range); });
    return sums;
}

// Work that finds more work: tasks that several threads take from one stack.

/// Tasks that wait, and the number of tasks that run.
template <class Task>
class TaskStack {
public:
    explicit TaskStack(Task first) { waiting_.push_back(std::move(first)); }

    void push(Task task) {
        const std::lock_guard lock(mutex_);
        waiting_.push_back(std::move(task));
        changed_.notify_one();
    }

    /// Runs tasks until none is left or one has thrown, in which case this throws it.
    template <class Body>
    void work(Body&& body) {
        std::unique_lock lock(mutex_);
        for (;;) {
            changed_.wait(lock, [this] { return !waiting_.empty() || running_ == 0; });
            if (waiting_.empty()) return;
            const Task task = std::move(waiting_.back());
            waiting_.pop_back();
            ++running_;
            lock.unlock();
            try {
                body(task);
            } catch (...) {
                lock.lock();
                waiting_.clear();
                finish_one();
                throw;
            }
            lock.lock();
            finish_one();
        }
    }

private:
    void finish_one() {
        --running_;
        if (waiting_.empty() && running_ == 0) changed_.notify_all();
    }

    std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<Task> waiting_;
    int running_ = 0;
};

/// Calls body(task, push) for `first` and for every task given to push(task), in any order, by up to `threads` threads.
template <class Task, class Body>
void run_tasks(Task first, int threads, Body&& body) {
    TaskStack<Task> stack(std::move(first));
    run_on_plain_threads(threads, [&](int) {
        stack.work([&](const Task& task) { body(task, [&](Task next) { stack.push(std::move(next)); }); });
    });
}

}  // namespace pl
