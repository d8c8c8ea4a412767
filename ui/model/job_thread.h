// The helper thread: saving and loading, one job after the other. A job returns its report, a function that the
// window's thread calls.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace pl::ui {

class JobThread {
public:
    using Report = std::function<void()>;
    using Job = std::function<Report()>;  ///< must not throw

    JobThread() : thread_([this] { run(); }) {}
    ~JobThread() { finish(); }
    JobThread(const JobThread&) = delete;
    JobThread& operator=(const JobThread&) = delete;

    void push(Job job) {
        {
            const std::lock_guard lock(mutex_);
            jobs_.push_back(std::move(job));
            ++pending_;
        }
        wake_.notify_all();
    }

    /// Finishes the queued jobs: a picture that was to be saved is written. No job may follow.
    void finish() {
        {
            const std::lock_guard lock(mutex_);
            quit_ = true;
        }
        wake_.notify_all();
        if (thread_.joinable()) thread_.join();
    }

    /// Reports of finished jobs, oldest first.
    std::vector<Report> take_reports() {
        const std::lock_guard lock(mutex_);
        return std::exchange(reports_, {});
    }

    /// Jobs that are not finished.
    int pending() const {
        const std::lock_guard lock(mutex_);
        return pending_;
    }

private:
    void run() {
        std::unique_lock lock(mutex_);
        while (true) {
            wake_.wait(lock, [&] { return quit_ || !jobs_.empty(); });
            if (jobs_.empty()) return;
            const Job job = std::move(jobs_.front());
            jobs_.pop_front();
            lock.unlock();
            Report report = job();
            lock.lock();
            reports_.push_back(std::move(report));
            --pending_;
        }
    }

    mutable std::mutex mutex_;
    std::condition_variable wake_;
    std::deque<Job> jobs_;
    std::vector<Report> reports_;
    int pending_ = 0;
    bool quit_ = false;
    std::thread thread_;  ///< last: it uses all members above
};

}  // namespace pl::ui
