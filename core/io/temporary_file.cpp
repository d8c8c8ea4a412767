#include "core/io/temporary_file.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace pl {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kPrefix = ".pathlight-";
constexpr std::string_view kSuffix = ".tmp";

/// Short, because the length of names is limited. A killed process with the same number may have left a name: the
/// next is tried.
fs::path next_name(const fs::path& folder) {
    static std::atomic<unsigned> counter{0};
    return folder / fmt::format("{}{}-{}{}", kPrefix, ::getpid(), counter.fetch_add(1), kSuffix);
}

/// Whether next_name() generates this name.
bool is_name_of_ours(std::string_view name) {
    if (!name.starts_with(kPrefix) || !name.ends_with(kSuffix)) return false;
    name.remove_prefix(kPrefix.size());
    name.remove_suffix(std::min(kSuffix.size(), name.size()));
    return !name.empty() && name.find_first_not_of("0123456789-") == std::string_view::npos;
}

bool has_name(int file) {
    struct ::stat status {};
    return ::fstat(file, &status) == 0 && status.st_nlink > 0;
}

/// Removes a file unless it is locked.
void remove_if_left(const fs::path& path) {
    const int file = ::open(path.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (file < 0) return;
    if (::flock(file, LOCK_EX | LOCK_NB) == 0) ::unlink(path.c_str());
    ::close(file);
}

}  // namespace

TemporaryFile::TemporaryFile(const fs::path& target) : target_(target) {
    // The name may be taken by a leftover file, or the file removed as a leftover before it is locked.
    constexpr int kTries = 100;
    for (int i = 0; i < kTries; ++i) {
        path_ = next_name(target.parent_path());
        file_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        error_ = file_ < 0 ? errno : 0;
        if (error_ == EEXIST) continue;
        if (error_ != 0) return;
        ::flock(file_, LOCK_EX);  // without locks on this file system, no process removes it either
        if (has_name(file_)) return;
        ::close(std::exchange(file_, -1));
        error_ = EEXIST;
    }
}

TemporaryFile::~TemporaryFile() {
    if (file_ < 0) return;
    ::unlink(path_.c_str());
    ::close(file_);
}

int TemporaryFile::replace_target(std::string_view bytes) {
    if (file_ < 0) return error_;
    // The duplicate shares the lock, which is held until the rename.
    const int copy = ::fcntl(file_, F_DUPFD_CLOEXEC, 0);
    if (copy < 0) return errno;
    if (const int error = write_and_close(copy, bytes)) return error;
    if (std::rename(path_.c_str(), target_.c_str()) != 0) return errno;
    ::close(std::exchange(file_, -1));
    return 0;
}

int write_and_close(int file, std::string_view bytes) {
    std::FILE* const stream = ::fdopen(file, "wb");
    if (stream == nullptr) {
        const int error = errno;
        ::close(file);
        return error;
    }
    const int error = std::fwrite(bytes.data(), 1, bytes.size(), stream) == bytes.size() ? 0 : errno;
    // fclose() flushes the buffer: errors such as a full disk may appear here.
    return std::fclose(stream) == 0 ? error : (error != 0 ? error : errno);
}

void remove_leftovers(const fs::path& folder) {
    std::error_code error;
    for (fs::directory_iterator entry(folder.empty() ? fs::path(".") : folder, error), end; !error && entry != end;
         entry.increment(error))
        if (is_name_of_ours(entry->path().filename().string())) remove_if_left(entry->path());
}

}  // namespace pl
