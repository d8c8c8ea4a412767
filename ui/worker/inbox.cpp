#include "ui/worker/inbox.h"

namespace pl::ui {

std::uint64_t Inbox::submit(WorkerEdit edit) {
    std::vector<WorkerEdit> edits;
    edits.push_back(std::move(edit));
    return submit_together(std::move(edits));
}

std::uint64_t Inbox::submit_together(std::vector<WorkerEdit> edits) {
    const std::lock_guard lock(mutex_);
    for (WorkerEdit& edit : edits) edits_.push(std::move(edit));
    interrupt(Interrupts::Pass);
    has_edit_ = may_be_interrupted_;
    return ++requests_.generation;
}

std::uint64_t Inbox::request(const std::function<Interrupts(Requests&)>& change) {
    const std::lock_guard lock(mutex_);
    interrupt(change(requests_));
    return requests_.generation;
}

/// The mutex is held.
void Inbox::interrupt(Interrupts interrupts) {
    const bool stops = interrupts == Interrupts::Pass || (interrupts == Interrupts::ShownPass && film_has_pass_);
    if (stops && may_be_interrupted_) stop_ = true;
    wake_.notify_all();
}

void Inbox::quit() {
    {
        const std::lock_guard lock(mutex_);
        quit_ = true;
        stop_ = true;
    }
    wake_.notify_all();
}

std::string Inbox::wanted_backend() const {
    const std::lock_guard lock(mutex_);
    return requests_.backend;
}

bool Inbox::take(Requests& now, std::vector<WorkerEdit>& edits, const std::function<bool()>& has_work) {
    std::unique_lock lock(mutex_);
    while (!quit_) {
        now = requests_;
        if (!edits_.empty() || has_work()) break;
        wake_.wait(lock);
    }
    if (quit_) return false;
    edits = edits_.take();
    requests_.once = {};
    stop_ = false;
    has_edit_ = false;
    return true;
}

void Inbox::begin_pass(bool may_be_interrupted, const Requests& now, const std::string& backend) {
    const std::lock_guard lock(mutex_);
    may_be_interrupted_ = may_be_interrupted;
    const bool other_frame = requests_.display != now.display || (requests_.values && !now.values);
    const bool has_click = requests_.once.pick || !requests_.once.places.empty();
    const bool is_late = !edits_.empty() || has_click || requests_.turns != now.turns ||
                         requests_.backend != backend ||
                         ((other_frame || requests_.volume != now.volume) && film_has_pass_);
    if (may_be_interrupted && is_late) stop_ = true;
    has_edit_ = may_be_interrupted && !edits_.empty();
}

void Inbox::settle_backend(const std::string& asked, const std::string& in_use) {
    const std::lock_guard lock(mutex_);
    if (requests_.backend == asked) requests_.backend = in_use;
}

}  // namespace pl::ui
