#include "ui/model/self_test_control.h"

#include "core/selftest/self_test.h"

namespace pl::ui {

void SelfTestControl::start() {
    is_shown_ = true;
    if (run_.is_running()) return;
    std::vector<std::string> backends;
    for (const BackendChoice& choice : options_.backends)
        if (choice.unavailable.empty()) backends.push_back(choice.name);
    run_.start([backends, make = options_.make_side_backend](const JobMonitor& monitor, const auto& told) {
        (void)run_self_test(backends, make, told, monitor.stop);
    });
    link_.hold(RenderLink::Hold::SelfTest, true);
}

void SelfTestControl::update() {
    if (!run_.update()) return;
    link_.hold(RenderLink::Hold::SelfTest, false);
    const bool is_good =
        run_.outcome() == SelfTestRun::Outcome::Passed || run_.outcome() == SelfTestRun::Outcome::Stopped;
    const std::string text = "self test: " + run_.summary();
    if (is_good)
        messages_.note(MessageLevel::Info, text);
    else
        messages_.say(MessageLevel::Error, text);
}

}  // namespace pl::ui
