// Checkpoints: the state of a session in a file, from which a rendering goes on with the bits of an uninterrupted one.
// Binary, little endian, versioned, with a checksum (sealed_file.h).
#pragma once

#include <filesystem>

#include "core/session/session_state.h"

namespace pl {

struct Checkpoint {
    double seconds = 0.0;  ///< of rendering so far, for limits of time
    SessionState state;
};

/// Writes atomically (write_file_atomic). Throws Error(Runtime) if the file cannot be written.
void write_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint);

/// Throws Error(Input) with the path for a file that is missing, of another kind or version, truncated, corrupt, or with invalid
/// values. The session checks whether it continues the same run.
Checkpoint read_checkpoint(const std::filesystem::path& path);

}  // namespace pl
