// File jobs on the helper thread; an exception of a job becomes an error message.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <sys/resource.h>

#include "ui/model/messages.h"
#include "ui/viewer.h"

namespace pl::ui {

/// The helper thread: saving and loading, one job after the other. A job returns its report, a function that the
/// window's thread calls.
class Jobs {
public:
    using Report = std::function<void()>;
    using Job = std::function<Report()>;

    explicit Jobs(Messages& messages) : messages_(messages), thread_([this] { run(); }) {}
    ~Jobs() { finish(); }
    Jobs(const Jobs&) = delete;
    Jobs& operator=(const Jobs&) = delete;

    /// `job` runs on the helper thread, the report it returns on the window's thread. An exception of a job becomes an error message.
    void push(Job job);
    /// Runs the reports of finished jobs; once per frame of the window.
    void update();

    /// Finishes the queued jobs: a picture that was to be saved is written. No job may follow.
    void finish() {
        {
            const std::lock_guard lock(mutex_);
            quit_ = true;
        }
        wake_.notify_all();
        if (thread_.joinable()) thread_.join();
    }

    /// Jobs that are not finished.
    int pending() const {
        const std::lock_guard lock(mutex_);
        return pending_;
    }

private:
    Report report_of(const Job& job);
    void run() {
        std::unique_lock lock(mutex_);
        while (true) {
            wake_.wait(lock, [&] { return quit_ || !jobs_.empty(); });
            if (jobs_.empty()) return;
            const Job job = std::move(jobs_.front());
            jobs_.pop_front();
            lock.unlock();
            Report report = report_of(job);
            lock.lock();
            reports_.push_back(std::move(report));
            --pending_;
        }
    }

    Messages& messages_;
    mutable std::mutex mutex_;
    std::condition_variable wake_;
    std::deque<Job> jobs_;
    std::vector<Report> reports_;
    int pending_ = 0;
    bool quit_ = false;
    std::thread thread_;  ///< last: it uses all members above
};

/// Background work with a progress bar: a thread of low priority, its progress, and a stop flag.
template <class Value>
class BackgroundJob {
public:
    using Make = std::function<Value(const JobMonitor&)>;

    explicit BackgroundJob(Make make) : thread_([this, make = std::move(make)] { run(make); }) {}
    /// Stops the work and waits for its end.
    ~BackgroundJob() {
        stop();
        thread_.join();
    }
    BackgroundJob(const BackgroundJob&) = delete;
    BackgroundJob& operator=(const BackgroundJob&) = delete;

    void stop() { stopped_ = true; }
    bool stopped() const { return stopped_; }

    struct Progress {
        double share = 0.0;  ///< of the whole, in [0, 1]
        std::string detail;
    };
    Progress progress() const {
        const std::lock_guard lock(mutex_);
        return progress_;
    }

    struct Result {
        Value value{};        ///< partial if the work was stopped
        std::string failure;  ///< empty if it did not fail
    };
    /// Once, after the end of the work.
    std::optional<Result> take_result() {
        const std::lock_guard lock(mutex_);
        return std::exchange(result_, std::nullopt);
    }

private:
    void run(const Make& make) {
        constexpr int kNice = 10;  // on Linux of this thread and the threads it starts: all others have priority
        (void)setpriority(PRIO_PROCESS, 0, kNice);
        const JobMonitor monitor{.stop = &stopped_, .progress = [this](double share, const std::string& detail) {
                                     const std::lock_guard lock(mutex_);
                                     progress_ = {share, detail};
                                 }};
        Result result;
        try {
            result.value = make(monitor);
        } catch (const std::exception& error) {
            result.failure = error.what();
        }
        const std::lock_guard lock(mutex_);
        result_ = std::move(result);
    }

    StopFlag stopped_{false};
    mutable std::mutex mutex_;
    Progress progress_;
    std::optional<Result> result_;
    std::thread thread_;  ///< last: it uses all members above
};

/// Renders a reference. Null if it was stopped before both halves had samples; else its samples are stored.
using ReferenceJob = BackgroundJob<std::shared_ptr<const StoredReference>>;

}  // namespace pl::ui
