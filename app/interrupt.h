// Ctrl+C: the first one asks for an orderly end, the second one ends the program.
#pragma once

#include "core/session/backend.h"

namespace pl {

/// While one lives, SIGINT and SIGTERM raise the flag instead of ending the program; a second signal ends it at once
/// with code 130. One at a time.
class InterruptGuard {
public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

    const StopFlag* flag() const;
    bool raised() const { return flag()->load(); }
};

inline constexpr int kExitInterrupted = 130;

}  // namespace pl
