// Work that finds more work: tasks that several threads take from one stack.
#pragma once

#include <condition_variable>
#include <mutex>
#include <utility>
#include <vector>

#include "core/base/work_queue.h"

namespace pl {

/// Tasks that wait, and the number of those that run.
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
