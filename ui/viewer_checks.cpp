// The part of ViewerModel that looks for diagnostics: where in the picture, and whether this machine computes right.
#include "core/selftest/self_test.h"
#include "ui/viewer_model.h"

namespace pl {

std::shared_ptr<const DiagnosticsMap> ViewerModel::diagnostics() const {
    return frame_ ? diagnostics_.map_of(*frame_) : nullptr;
}

void ViewerModel::toggle_diagnostics() {
    if (diagnostics_.is_searching())
        diagnostics_.stop();
    else if (diagnostics())
        diagnostics_.drop();
    else
        find_diagnostics();
}

void ViewerModel::find_diagnostics() {
    if (diagnostics_.is_searching()) return;
    set_turns(false);
    diagnostics_.expect_answer();
    worker_.request_diagnostics();
    hold_rendering();
}

void ViewerModel::take_diagnostics() {
    if (auto answer = worker_.take_diagnostics()) {
        if (!answer->source) say(LogLevel::Info, answer->reason);
        diagnostics_.begin(std::move(*answer));
        hold_rendering();
    }
    const auto result = diagnostics_.update(status_.generation);
    if (!result) return;
    hold_rendering();
    if (!result->failure.empty())
        say(LogLevel::Error, "the search for diagnostics failed: " + result->failure);
    else if (result->value)
        say(LogLevel::Info, summary_of(*result->value));
}

void ViewerModel::start_self_test() {
    window_.self_test = true;
    if (self_test_.is_running()) return;
    std::vector<std::string> backends;
    for (const BackendChoice& choice : options_.backends)
        if (choice.unavailable.empty()) backends.push_back(choice.name);
    self_test_.start([backends, make = options_.make_backend](const JobMonitor& monitor, const auto& told) {
        (void)run_self_test(backends, make, told, monitor.stop);
    });
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
