#include "app/interrupt.h"

#include <unistd.h>

namespace pl {
namespace {

// Signal handlers reach globals only.
StopFlag raised_stop{false};
static_assert(StopFlag::is_always_lock_free, "signal handlers may only touch lock-free atomics");

void on_signal(int) {
    if (raised_stop.exchange(true)) _exit(kExitInterrupted);
}

/// Whether the program was started by `nohup`, or by something else for which a closed terminal is no reason to stop.
bool is_left_alone(int signal, const struct sigaction& before) {
    return signal == SIGHUP && before.sa_handler == SIG_IGN;
}

}  // namespace

InterruptGuard::InterruptGuard() {
    raised_stop = false;
    struct sigaction action {};
    action.sa_handler = on_signal;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    for (std::size_t i = 0; i < kStopSignals.size(); ++i) {
        sigaction(kStopSignals[i], nullptr, &before_[i]);
        if (!is_left_alone(kStopSignals[i], before_[i])) sigaction(kStopSignals[i], &action, nullptr);
    }
}

InterruptGuard::~InterruptGuard() {
    for (std::size_t i = 0; i < kStopSignals.size(); ++i) sigaction(kStopSignals[i], &before_[i], nullptr);
}

const StopFlag* InterruptGuard::flag() const { return &raised_stop; }

}  // namespace pl
