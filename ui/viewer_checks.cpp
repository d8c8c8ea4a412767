// The part of ViewerModel that looks for trouble: where in the picture, and whether this machine computes right.
#include "ui/viewer_model.h"

namespace pl {

std::shared_ptr<const TroubleMap> ViewerModel::trouble() const { return frame_ ? trouble_.map_of(*frame_) : nullptr; }

void ViewerModel::toggle_trouble() {
    if (trouble_.is_searching())
        trouble_.stop();
    else if (trouble())
        trouble_.drop();
    else
        find_trouble();
}

void ViewerModel::find_trouble() {
    if (trouble_.is_searching()) return;
    set_turns(false);
    trouble_.expect_answer();
    worker_.request_trouble();
    hold_rendering();
}

void ViewerModel::take_trouble() {
    if (auto answer = worker_.take_trouble()) {
        if (!answer->source) say(LogLevel::Info, answer->reason);
        trouble_.begin(std::move(*answer));
        hold_rendering();
    }
    const auto result = trouble_.update(status_.generation);
    if (!result) return;
    hold_rendering();
    if (!result->failure.empty())
        say(LogLevel::Error, "the search for trouble failed: " + result->failure);
    else if (result->value)
        say(LogLevel::Info, summary_of(*result->value));
}

void ViewerModel::start_self_test() {
    window_.self_test = true;
    if (self_test_.is_running()) return;
    if (!options_.run_self_test) {
        say(LogLevel::Warning, "this build has no self test");
        return;
    }
    self_test_.start(options_.run_self_test);
    hold_rendering();
}

void ViewerModel::stop_self_test() { self_test_.stop(); }

void ViewerModel::take_self_test() {
    if (!self_test_.update()) return;
    hold_rendering();
    const bool is_good =
        self_test_.outcome() == SelfTestRun::Outcome::Passed || self_test_.outcome() == SelfTestRun::Outcome::Stopped;
    const std::string text = "self test: " + self_test_.summary();
    if (is_good)
        note(LogLevel::Info, text);
    else
        say(LogLevel::Error, text);
}

}  // namespace pl
