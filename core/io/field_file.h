// Files of learned fields. Binary, little endian, versioned, with a checksum; they hold the exact bits, so that a run that
// continues from a file equals one that never stopped.
//   "PLFIELD\n" | u32 version | u64 bytes of the file | settings, shape, progress | arrays, each behind its count |
//   u64 Fnv1a of all before
#pragma once

#include <filesystem>

#include "core/session/learned_field.h"

namespace pl {

/// The file appears under its name only when it is complete. Throws Error(Runtime) if it cannot be written.
void write_field(const std::filesystem::path& path, const LearnedField& field);

/// Throws Error(Input), with the path, for a file that is missing, of another kind or version, truncated or changed, or whose
/// values no session can produce. The session checks the scene.
LearnedField read_field(const std::filesystem::path& path);

}  // namespace pl
