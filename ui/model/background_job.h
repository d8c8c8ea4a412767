// Background work with a progress bar: a thread of low priority, its progress, and a stop flag.
#pragma once

#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include <sys/resource.h>

#include "ui/viewer.h"

namespace pl::ui {

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
