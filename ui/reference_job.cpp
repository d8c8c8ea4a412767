#include "ui/reference_job.h"

#include <utility>

#include <sys/resource.h>

namespace pl {

ReferenceJob::ReferenceJob(Make make) : thread_([this, make = std::move(make)] { run(make); }) {}

ReferenceJob::~ReferenceJob() {
    stop();
    thread_.join();
}

ReferenceJob::Progress ReferenceJob::progress() const {
    const std::lock_guard lock(mutex_);
    return progress_;
}

std::optional<ReferenceJob::Result> ReferenceJob::take_result() {
    const std::lock_guard lock(mutex_);
    return std::exchange(result_, std::nullopt);
}

void ReferenceJob::run(const Make& make) {
    constexpr int kNice = 10;  // on Linux about this thread and those that it starts: everything else comes first
    (void)setpriority(PRIO_PROCESS, 0, kNice);
    const ReferenceMonitor monitor{.stopped = [this] { return stopped_.load(); },
                                   .progress =
                                       [this](double share, const std::string& detail) {
                                           const std::lock_guard lock(mutex_);
                                           progress_ = {share, detail};
                                       }};
    Result result;
    try {
        result.reference = make(monitor);
    } catch (const std::exception& error) {
        result.failure = error.what();
    }
    const std::lock_guard lock(mutex_);
    result_ = std::move(result);
}

}  // namespace pl
