// A temporary file beside its target, under a unique hidden name. The writer holds a lock on it, by which other
// processes distinguish it from the leftovers of killed ones.
#pragma once

#include <filesystem>
#include <string_view>

namespace pl {

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
