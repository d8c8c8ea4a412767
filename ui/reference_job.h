// A reference in the making: a thread of low priority, its progress, and a way to stop it. What it has by then is stored.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "ui/viewer.h"

namespace pl {

class ReferenceJob {
public:
    using Make = std::function<std::shared_ptr<const StoredReference>(const ReferenceMonitor&)>;

    explicit ReferenceJob(Make make);
    /// Stops it, and waits for the pass under way.
    ~ReferenceJob();
    ReferenceJob(const ReferenceJob&) = delete;
    ReferenceJob& operator=(const ReferenceJob&) = delete;

    void stop() { stopped_ = true; }
    bool stopped() const { return stopped_; }

    struct Progress {
        double share = 0.0;  ///< of the whole, in [0, 1]
        std::string detail;
    };
    Progress progress() const;

    struct Result {
        std::shared_ptr<const StoredReference> reference;  ///< null if it was stopped before there was any, or failed
        std::string failure;                               ///< empty if it did not fail
    };
    /// Once, when it is over.
    std::optional<Result> take_result();

private:
    void run(const Make& make);

    std::atomic<bool> stopped_{false};
    mutable std::mutex mutex_;
    Progress progress_;
    std::optional<Result> result_;
    std::thread thread_;  ///< last: starts when all else is there
};

}  // namespace pl
