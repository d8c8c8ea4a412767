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

void handle(int signal, void (*handler)(int)) {
    struct sigaction action {};
    action.sa_handler = handler;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    sigaction(signal, &action, nullptr);
}

/// Whether the program was started by `nohup`, or by something else for which a closed terminal is no reason to stop.
bool outlives_terminal() {
    struct sigaction action {};
    return sigaction(SIGHUP, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

void install(void (*handler)(int)) {
    const bool leave_hangup = outlives_terminal();
    for (const int signal : kStopSignals)
        if (signal != SIGHUP || !leave_hangup) handle(signal, handler);
}

}  // namespace

InterruptGuard::InterruptGuard() {
    raised_stop = false;
    install(on_signal);
}

InterruptGuard::~InterruptGuard() { install(SIG_DFL); }

const StopFlag* InterruptGuard::flag() const { return &raised_stop; }

}  // namespace pl
