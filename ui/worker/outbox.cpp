#include "ui/worker/outbox.h"

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
