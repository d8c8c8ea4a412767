// Ctrl+C and its kind: the first one asks for an orderly end, the second one ends the program.
#pragma once

#include <array>
#include <csignal>

#include "core/session/backend.h"

namespace pl {

/// Of Ctrl+C, of `kill`, and of a terminal that is closed.
inline constexpr std::array kStopSignals{SIGINT, SIGTERM, SIGHUP};

/// While one lives, kStopSignals raise the flag instead of ending the program; a second signal ends it at once
/// with code 130. A program that was started to ignore SIGHUP, as `nohup` does, goes on to. At its end the
/// handlers of before come back. One at a time.
class InterruptGuard {
public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

    const StopFlag* flag() const;
    bool raised() const { return flag()->load(); }

private:
    std::array<struct sigaction, kStopSignals.size()> before_{};
};

inline constexpr int kExitInterrupted = 130;

}  // namespace pl
