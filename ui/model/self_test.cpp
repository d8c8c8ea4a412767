#include "ui/model/self_test.h"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/selftest/self_test.h"

namespace pl::ui {
namespace {

std::string checks_text(std::size_t count) { return fmt::format("{} {}", count, count == 1 ? "check" : "checks"); }

}  // namespace

void SelfTestRun::start(Checks run) {
    if (job_) return;
    incoming_ = std::make_shared<Incoming>();
    checks_.clear();
    failure_.clear();
    was_stopped_ = false;
    outcome_ = Outcome::Running;
    job_ = std::make_unique<BackgroundJob<std::monostate>>(
        [run = std::move(run), incoming = incoming_](const JobMonitor& monitor) {
            run(monitor, [&](const SelfCheck& check) {
                const std::lock_guard lock(incoming->mutex);
                incoming->checks.push_back(check);
            });
            return std::monostate{};
        });
}

void SelfTestRun::stop() {
    if (!job_) return;
    was_stopped_ = true;
    job_->stop();
}

bool SelfTestRun::update() {
    if (!job_) return false;
    const auto result = job_->take_result();
    take_checks();
    if (!result) return false;
    job_.reset();
    failure_ = result->failure;
    const bool all_passed = std::ranges::all_of(checks_, &SelfCheck::passed);
    if (!failure_.empty())
        outcome_ = Outcome::Broken;
    else if (!all_passed)
        outcome_ = Outcome::Failed;
    else
        outcome_ = was_stopped_ ? Outcome::Stopped : Outcome::Passed;
    return true;
}

void SelfTestRun::take_checks() {
    const std::lock_guard lock(incoming_->mutex);
    std::ranges::move(incoming_->checks, std::back_inserter(checks_));
    incoming_->checks.clear();
}

std::string SelfTestRun::summary() const {
    const auto failed = std::ranges::count(checks_, false, &SelfCheck::passed);
    double seconds = 0.0;
    std::vector<std::string> backends;
    for (const SelfCheck& check : checks_) {
        seconds += check.seconds;
        if (backends.empty() || backends.back() != check.backend) backends.push_back(check.backend);
    }
    switch (outcome_) {
    case Outcome::None: return "";
    case Outcome::Running: return fmt::format("{} so far, {} failed", checks_text(checks_.size()), failed);
    case Outcome::Passed:
        return fmt::format("all {} checks passed in {:.1f} s on {}", checks_.size(), seconds,
                           fmt::join(backends, ", "));
    case Outcome::Failed:
        return fmt::format("{} of {} checks failed: this machine's results are outside the tolerances", failed,
                           checks_.size());
    case Outcome::Stopped: return fmt::format("ended after {}, without a failure", checks_text(checks_.size()));
    case Outcome::Broken:
        return fmt::format("stopped by an error after {}: {}", checks_text(checks_.size()), failure_);
    }
    return "";
}

const char* name_of(SelfTestRun::Outcome outcome) {
    switch (outcome) {
    case SelfTestRun::Outcome::None: return "none";
    case SelfTestRun::Outcome::Running: return "running";
    case SelfTestRun::Outcome::Passed: return "passed";
    case SelfTestRun::Outcome::Failed: return "failed";
    case SelfTestRun::Outcome::Stopped: return "stopped";
    case SelfTestRun::Outcome::Broken: return "broken";
    }
    return "";
}

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
