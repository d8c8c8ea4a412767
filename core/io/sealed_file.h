// Binary files with a kind, a version, their size and a checksum, so that a reader refuses any that is not whole and its own:
//   magic, 8 bytes | u32 version | u64 bytes of the file | content | u64 Fnv1a of all preceding bytes
#pragma once

#include "core/io/binary_stream.h"

namespace pl {

struct SealedKind {
    std::string_view magic;  ///< 8 bytes, the last one a line feed
    std::uint32_t version = 1;
    std::string_view title;  ///< in messages: "learned field"
    std::string_view word;   ///< the same, shorter: "field"
};

/// A writer that has begun a file; the content follows.
BinaryWriter begin_sealed(const SealedKind& kind);
/// Seals the content of begin_sealed() and writes it atomically (write_file_atomic). Throws Error(Runtime) if that fails.
void write_sealed(const std::filesystem::path& path, BinaryWriter writer);

/// The content of a file's bytes. Throws Error(Input) unless kind, version, size and checksum are right.
std::string_view sealed_content(std::string_view bytes, const std::filesystem::path& path, const SealedKind& kind);

}  // namespace pl
