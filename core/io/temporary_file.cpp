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

/// Short, because names are limited. Another process may have had this number, and been killed: then the next one is free.
fs::path next_name(const fs::path& folder) {
    static std::atomic<unsigned> counter{0};
    return folder / fmt::format("{}{}-{}{}", kPrefix, ::getpid(), counter.fetch_add(1), kSuffix);
}

/// Is it one that next_name() makes?
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

/// Removes a file if nobody holds its lock.
void remove_if_left(const fs::path& path) {
    const int file = ::open(path.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (file < 0) return;
    if (::flock(file, LOCK_EX | LOCK_NB) == 0) ::unlink(path.c_str());
    ::close(file);
}

}  // namespace

TemporaryFile::TemporaryFile(const fs::path& target) : target_(target) {
    // A name can be taken by what is left of another process, or its file be removed as such before it is locked.
    constexpr int kTries = 100;
    for (int i = 0; i < kTries; ++i) {
        path_ = next_name(target.parent_path());
        file_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        error_ = file_ < 0 ? errno : 0;
        if (error_ == EEXIST) continue;
        if (error_ != 0) return;
        ::flock(file_, LOCK_EX);  // where there are no locks, nobody takes one to remove it
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
    // The copy shares the lock, which stays until the file has its name.
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
    // The buffer is written here: a full disk shows up at the latest in this call.
    return std::fclose(stream) == 0 ? error : (error != 0 ? error : errno);
}

void remove_leftovers(const fs::path& folder) {
    std::error_code error;
    for (fs::directory_iterator entry(folder.empty() ? fs::path(".") : folder, error), end; !error && entry != end;
         entry.increment(error))
        if (is_name_of_ours(entry->path().filename().string())) remove_if_left(entry->path());
}

}  // namespace pl
