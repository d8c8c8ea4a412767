// The self test in the background: its checks as they finish, and its outcome.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "core/selftest/self_test.h"
#include "ui/model/background_job.h"

namespace pl::ui {

class SelfTestRun {
public:
    enum class Outcome { None, Running, Passed, Failed, Stopped, Broken };

    /// Runs the checks, and calls `told` after each of them.
    using Checks = std::function<void(const JobMonitor&, const std::function<void(const SelfCheck&)>& told)>;

    /// Begins anew, on a thread of its own.
    void start(Checks run);
    void stop();
    bool is_running() const { return job_ != nullptr; }
    /// Takes finished checks, once per frame of the window. True once, at the end of the test.
    bool update();

    const std::vector<SelfCheck>& checks() const { return checks_; }
    Outcome outcome() const { return outcome_; }
    /// "24 checks passed in 9.8 s on cpu, cuda", "2 of 24 checks failed: ...".
    std::string summary() const;

private:
    /// Filled by the test's thread, which may still run when a new test starts.
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

}  // namespace pl::ui
