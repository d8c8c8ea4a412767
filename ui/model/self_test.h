// The self test in the window: it runs in the background, and rendering rests meanwhile.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "core/selftest/self_test.h"
#include "ui/model/jobs.h"
#include "ui/model/render_link.h"

namespace pl::ui {

/// The self test in the background: its checks as they finish, and its outcome.
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
    std::unique_ptr<BackgroundJob<std::monostate>> job_;
};

const char* name_of(SelfTestRun::Outcome outcome);

/// The self test in the window: its dialog, its start and end. Rendering rests while it runs.
class SelfTestControl {
public:
    explicit SelfTestControl(const ModelServices& services)
        : options_(services.options), messages_(services.messages), link_(services.link) {}

    /// Takes results; once per frame of the window.
    void update();

    const SelfTestRun& run() const { return run_; }
    bool& is_shown() { return is_shown_; }  ///< the dialog is open
    bool is_shown() const { return is_shown_; }
    /// Also opens the dialog.
    void start();
    void stop() { run_.stop(); }

private:
    const ViewerOptions& options_;
    Messages& messages_;
    RenderLink& link_;
    SelfTestRun run_;
    bool is_shown_ = false;
};

}  // namespace pl::ui
