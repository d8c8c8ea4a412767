// The self test in the background of a window: results one by one, and what came of it.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "core/selftest/self_check.h"
#include "ui/background_job.h"

namespace pl {

class SelfTestRun {
public:
    enum class Outcome { None, Running, Passed, Failed, Stopped, Broken };

    /// Runs the checks, and calls `told` after each of them.
    using Checks = std::function<void(const JobMonitor&, const std::function<void(const SelfCheck&)>& told)>;

    /// Begins anew, on a thread of its own.
    void start(Checks run);
    void stop();
    bool is_running() const { return job_ != nullptr; }
    /// Once per frame of the window: takes what is there. True once, when the test is over.
    bool update();

    const std::vector<SelfCheck>& checks() const { return checks_; }
    Outcome outcome() const { return outcome_; }
    /// "24 checks passed in 9.8 s on cpu, cuda", "2 of 24 checks failed: ...".
    std::string summary() const;

private:
    /// What the test's thread fills; it may outlive the window's interest in it.
    struct Incoming {
        std::mutex mutex;
        std::vector<SelfCheck> checks;
    };

    void take_checks();

    std::shared_ptr<Incoming> incoming_ = std::make_shared<Incoming>();
    std::vector<SelfCheck> checks_;
    Outcome outcome_ = Outcome::None;
    std::string failure_;
    bool was_stopped_ = false;
    struct Nothing {};
    std::unique_ptr<BackgroundJob<Nothing>> job_;
};

const char* name_of(SelfTestRun::Outcome outcome);

}  // namespace pl
