// `pathlight render --camera-path`: the pictures of a moving camera.
#pragma once

#include <string>

#include "app/console.h"
#include "app/field_files.h"
#include "app/interrupt.h"
#include "core/session/session.h"

namespace pl {

/// Before anything is rendered. Throws Error: Usage for an output without a place for the frame's number, Input for a missing
/// camera path, Runtime if the output cannot be written.
void require_sequence(const Options& options);

/// Renders frame after frame, each up to the limits of the options, and writes each when it is complete. Volumes and learned
/// tables stay when the camera moves, as in the viewer. Returns the exit code; after an interruption the frame under way is not
/// written. Throws Error: Usage for fewer than two cameras, Threshold if frames missed --target-error.
int render_sequence(Session& session, const Options& options, const std::string& command, const FieldFiles& fields,
                    const InterruptGuard& interrupt, Console& console);

}  // namespace pl
