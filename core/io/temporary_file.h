// A file that is being written, under a hidden name of its own beside the one that it is meant for. Its writer holds a lock
// on it, so that others can tell the file of a writer that lives from what is left of one that was killed.
#pragma once

#include <filesystem>
#include <string_view>

namespace pl {

class TemporaryFile {
public:
    /// Beside `target`; error() tells whether it could be made.
    explicit TemporaryFile(const std::filesystem::path& target);
    /// Removes it, unless it has taken its target's place.
    ~TemporaryFile();
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    /// 0, or the number of the error.
    int error() const { return error_; }
    /// Writes these bytes and takes the target's place; 0 or the number of the error. Once.
    int replace_target(std::string_view bytes);

private:
    std::filesystem::path target_;
    std::filesystem::path path_;
    int file_ = -1;  ///< holds the lock
    int error_ = 0;
};

/// Writes to an open file and closes it; 0 or the number of the error.
int write_and_close(int file, std::string_view bytes);

/// Removes what writers that were killed have left in a folder, and nothing else: files that are locked are of writers that
/// live. Where the file system knows no locks, nothing is removed.
void remove_leftovers(const std::filesystem::path& folder);

}  // namespace pl
