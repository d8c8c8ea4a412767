// Whole files in and out. A written file appears under its name only when it is complete.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace pl {

/// The bytes of a regular file. Throws Error(Input): missing, a directory, a device, not readable.
std::string read_file(const std::filesystem::path& path);

/// As read_file(), without a leading UTF-8 byte order mark.
std::string read_text_file(const std::filesystem::path& path);

/// With its dot, in lower case.
std::string suffix_of(const std::filesystem::path& path);

/// Relative, and not out of the folder that it is relative to.
bool stays_inside(const std::filesystem::path& path);

/// Writes a temporary file beside `path` and renames it, so readers see the old content or the new, never a part.
/// A link is followed; a device or a pipe is written directly. Throws Error(Runtime) with path and reason, and
/// then leaves nothing behind. What killed writers have left in the folder is removed when a process first writes there.
void write_file_atomic(const std::filesystem::path& path, std::string_view bytes);

/// write_file_atomic() under the name that says what the bytes are.
inline void write_text_file_atomic(const std::filesystem::path& path, std::string_view text) {
    write_file_atomic(path, text);
}

}  // namespace pl
