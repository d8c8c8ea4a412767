// Learned fields in files: what a method learned, to go on with later or elsewhere. Binary, little endian, versioned,
// guarded by a checksum; holds the exact bits, so going on from a file is the same as never having stopped.
//   "PLFIELD\n" | u32 version | u64 bytes of the file | settings, shape, progress | arrays, each behind its count |
//   u64 Fnv1a of all before
#pragma once

#include <filesystem>

#include "core/session/learned_field.h"

namespace pl {

/// The file appears under its name only when it is complete. Throws Error(Runtime) if it cannot be written.
void write_field(const std::filesystem::path& path, const LearnedField& field);

/// Throws Error(Input), with the path, for a file that is missing, of another kind or version, cut off, changed, or
/// that holds what no session could have learned. Whether the scene is the right one is for the session to say.
LearnedField read_field(const std::filesystem::path& path);

}  // namespace pl
