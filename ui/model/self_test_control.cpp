#include "ui/model/self_test_control.h"

namespace pl {

void SelfTestControl::start() {
    is_shown_ = true;
    if (run_.is_running()) return;
    if (!options_.run_self_test) {
        messages_.say(MessageLevel::Warning, "this build has no self test");
        return;
    }
    run_.start(options_.run_self_test);
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

}  // namespace pl
