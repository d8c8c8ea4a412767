// `pathlight trace --why`: the noise of a pixel by technique, bounces and light, and the gain of guidance there.
#pragma once

#include "app/console.h"
#include "app/interrupt.h"
#include "app/options.h"
#include "core/session/session.h"

namespace pl {

/// Trains the session, which has to train by every pass, and prints the noise. Returns the exit code.
int trace_noise(Session& session, const Options& options, const InterruptGuard& interrupt, Console& console);

}  // namespace pl
