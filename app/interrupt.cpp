#include "app/interrupt.h"

#include <csignal>

#include <unistd.h>

namespace pl {
namespace {

// Signal handlers reach globals only.
StopFlag interrupted{false};
static_assert(StopFlag::is_always_lock_free, "signal handlers may only touch lock-free atomics");

void on_signal(int) {
    if (interrupted.exchange(true)) _exit(kExitInterrupted);
}

void install(void (*handler)(int)) {
    struct sigaction action {};
    action.sa_handler = handler;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    for (const int signal : {SIGINT, SIGTERM}) sigaction(signal, &action, nullptr);
}

}  // namespace

InterruptGuard::InterruptGuard() {
    interrupted = false;
    install(on_signal);
}

InterruptGuard::~InterruptGuard() { install(SIG_DFL); }

const StopFlag* InterruptGuard::flag() const { return &interrupted; }

}  // namespace pl
