// Learned fields in files, to resume learning later or elsewhere. Binary, little endian, versioned, with a checksum.
// The bits are exact, so resuming from a file equals an uninterrupted run.
//   "PLFIELD\n" | u32 version | u64 bytes of the file | settings, shape, progress | arrays, each behind its count |
//   u64 Fnv1a of all preceding bytes
#pragma once

#include <filesystem>

#include "core/session/learned_field.h"

namespace pl {

/// Writes atomically (write_file_atomic). Throws Error(Runtime) if the file cannot be written.
void write_field(const std::filesystem::path& path, const LearnedField& field);

/// Throws Error(Input) with the path for a file that is missing, of another kind or version, truncated, corrupt, or
/// with invalid values (require_usable). The session checks whether the field belongs to its scene.
LearnedField read_field(const std::filesystem::path& path);

}  // namespace pl
