#include "ui/worker/outbox.h"

#include <utility>

namespace pl::ui {

std::shared_ptr<const PublishedFrame> Outbox::latest() {
    const std::lock_guard lock(mutex_);
    is_frame_taken_ = true;
    return frame_;
}

WorkerStatus Outbox::status() const {
    const std::lock_guard lock(mutex_);
    return status_;
}

std::shared_ptr<const LiveRunSet> Outbox::runs() const {
    const std::lock_guard lock(mutex_);
    return runs_;
}

std::vector<WorkerMessage> Outbox::take_messages() {
    const std::lock_guard lock(mutex_);
    return std::exchange(messages_, {});
}

std::optional<PickAnswer> Outbox::take_pick() {
    const std::lock_guard lock(mutex_);
    return std::exchange(pick_, std::nullopt);
}

std::optional<LearnedAnswer> Outbox::take_learned() {
    const std::lock_guard lock(mutex_);
    return std::exchange(learned_, std::nullopt);
}

std::optional<DiagnosticsAnswer> Outbox::take_diagnostics() {
    const std::lock_guard lock(mutex_);
    return std::exchange(diagnostics_, std::nullopt);
}

std::optional<PathsAnswer> Outbox::take_paths() {
    const std::lock_guard lock(mutex_);
    return std::exchange(paths_, std::nullopt);
}

std::optional<GainAnswer> Outbox::take_gain() {
    const std::lock_guard lock(mutex_);
    return std::exchange(gain_, std::nullopt);
}

std::shared_ptr<const FieldHistory> Outbox::history() const {
    const std::lock_guard lock(mutex_);
    return history_;
}

std::exception_ptr Outbox::failure() const {
    const std::lock_guard lock(mutex_);
    return failure_;
}

void Outbox::publish(std::shared_ptr<PublishedFrame> frame) {
    const std::lock_guard lock(mutex_);
    frame->serial = frame_count_.load(std::memory_order_relaxed) + 1;
    frame_ = std::move(frame);
    is_frame_taken_ = false;
    frame_count_.fetch_add(1, std::memory_order_release);
}

bool Outbox::is_frame_taken() const {
    const std::lock_guard lock(mutex_);
    return is_frame_taken_;
}

void Outbox::set_status(const WorkerStatus& status) {
    const std::lock_guard lock(mutex_);
    status_ = status;
}

void Outbox::set_runs(std::shared_ptr<const LiveRunSet> runs) {
    const std::lock_guard lock(mutex_);
    runs_ = std::move(runs);
}

void Outbox::report(WorkerMessage message) {
    const std::lock_guard lock(mutex_);
    messages_.push_back(std::move(message));
}

void Outbox::answer(PickAnswer answer) {
    const std::lock_guard lock(mutex_);
    pick_ = answer;
}

void Outbox::answer(LearnedAnswer answer) {
    const std::lock_guard lock(mutex_);
    learned_ = std::move(answer);
}

void Outbox::answer(DiagnosticsAnswer answer) {
    const std::lock_guard lock(mutex_);
    diagnostics_ = std::move(answer);
}

void Outbox::answer(PathsAnswer answer) {
    const std::lock_guard lock(mutex_);
    paths_ = std::move(answer);
}

void Outbox::answer(GainAnswer answer) {
    const std::lock_guard lock(mutex_);
    gain_ = std::move(answer);
}

void Outbox::set_history(std::shared_ptr<const FieldHistory> history) {
    const std::lock_guard lock(mutex_);
    history_ = std::move(history);
}

void Outbox::fail(std::exception_ptr failure) {
    const std::lock_guard lock(mutex_);
    failure_ = std::move(failure);
    status_.state = WorkerState::Failed;
}

}  // namespace pl::ui
