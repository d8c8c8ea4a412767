// The part of RenderLoop that changes the back end, on request or because one has failed.
#include <fmt/format.h>

#include "ui/worker/render_loop.h"

namespace pl::ui {

/// Runs a step. If a back end fails in it, another takes over and repeats it. False, with a message about the reason,
/// if the step cannot be done.
bool RenderLoop::attempt(const std::function<void()>& step) {
    for (;;) {
        try {
            step();
            return true;
        } catch (const std::exception& error) {
            if (backends_.on_fallback() || !is_fault_of_backend(error)) {
                outbox_.report({true, error.what()});
                return false;
            }
            if (!take_over(error)) return false;
        }
    }
}

/// Messages come last: the state that they report is visible before them.
void RenderLoop::change_backend() {
    preview_.release();
    const std::string wanted = now_.backend;
    WorkerMessage message;
    try {
        message = backends_.switch_to(*session_, wanted);
        backend_changed();
    } catch (const std::exception& error) {
        message = {true, fmt::format("cannot switch to {}: {}. {} goes on", back_end_label(wanted),
                                     reason_of(error, wanted), back_end_label(backends_.current()))};
    }
    settle_backend(wanted);
    outbox_.report(std::move(message));
}

bool RenderLoop::take_over(const std::exception& error) {
    const std::string failed = backends_.current();
    WorkerMessage message;
    try {
        message = backends_.take_over(*session_, error);
    } catch (const std::exception& second) {
        outbox_.report({true, fmt::format("{} failed: {}. No other back end can take over: {}",
                                          back_end_label(failed), reason_of(error, failed), second.what())});
        return false;
    }
    backend_changed();
    settle_backend(failed);
    outbox_.report(std::move(message));
    return true;
}

void RenderLoop::backend_changed() {
    failed_ = false;
    second_.reset();
    selected_.invalidate();
    for (Inspection& pin : pins_) pin.invalidate();
    frames_.ask();
    size_.forget_cost();
    update_status();
}

/// The request for this back end is settled with the one in use now.
void RenderLoop::settle_backend(const std::string& asked) {
    inbox_.settle_backend(asked, backends_.current());
    if (now_.backend == asked) now_.backend = backends_.current();
}

}  // namespace pl::ui
