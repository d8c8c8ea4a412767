// Reading and atomic writing of whole files.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace pl {

/// The bytes of a regular file. Throws Error(Input) if it is missing, a directory, a device, or not readable, MemoryError if it is too
/// large for the memory.
std::string read_file(const std::filesystem::path& path);

/// As read_file(), in UTF-8 without a byte order mark; a file that starts with a byte order mark of UTF-16 is
/// converted. Throws Error(Input) also for damaged UTF-16.
std::string read_text_file(const std::filesystem::path& path);

/// File name extension with its dot, in lower case.
std::string suffix_of(const std::filesystem::path& path);

/// Whether a path is relative to the folder and stays inside, also where its links lead.
bool stays_inside(const std::filesystem::path& folder, const std::filesystem::path& path);

/// Writes a temporary file beside `path` and renames it, so that readers see the old or the new content, never a
/// part. Links are followed; devices and pipes are written directly. Throws Error(Runtime) with path and reason and
/// leaves no temporary file. The first write of a process to a folder removes temporary files of killed processes.
void write_file_atomic(const std::filesystem::path& path, std::string_view bytes);

/// Throws the Error(Runtime) of a file that cannot be written.
[[noreturn]] void fail_write(const std::filesystem::path& path, const std::string& why);

/// A temporary file beside its target, under a unique hidden name. The writer holds a lock on it, by which other
/// processes distinguish it from the leftovers of killed ones.
class TemporaryFile {
public:
    /// Creates the file beside `target`; error() returns the result.
    explicit TemporaryFile(const std::filesystem::path& target);
    /// Removes the file, unless it has replaced its target.
    ~TemporaryFile();
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    /// 0 or errno.
    int error() const { return error_; }
    /// Writes the bytes and renames the file to the target; returns 0 or errno. To be called once.
    int replace_target(std::string_view bytes);

private:
    std::filesystem::path target_;
    std::filesystem::path path_;
    int file_ = -1;  ///< holds the lock
    int error_ = 0;
};

/// Writes to an open file and closes it; returns 0 or errno.
int write_and_close(int file, std::string_view bytes);

/// Removes the temporary files of killed processes from a folder; locked files belong to running ones. Without file
/// locks on the file system, nothing is removed.
void remove_leftovers(const std::filesystem::path& folder);

}  // namespace pl
