#include "core/io/files.h"

#include <algorithm>
#include <atomic>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/memory.h"

namespace pl {

namespace fs = std::filesystem;

namespace {

struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using FileHandle = std::unique_ptr<std::FILE, CloseFile>;

std::string reason(int error_number) { return std::generic_category().message(error_number); }

[[noreturn]] void fail_read(const fs::path& path, const std::string& why) {
    throw Error(ErrorKind::Input, fmt::format("{}: cannot be read: {}", path.string(), why));
}

/// Writes to a device or pipe; returns 0 or errno.
int write_through(const fs::path& path, std::string_view bytes) {
    const int file = ::open(path.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC);
    return file < 0 ? errno : write_and_close(file, bytes);
}

/// Removes temporary files of killed processes, at the first write of this process to the folder.
void clear_once(const fs::path& folder) {
    static std::mutex mutex;
    static std::set<fs::path> cleared;
    const std::lock_guard lock(mutex);
    if (cleared.insert(folder).second) {
        remove_leftovers(folder);
    }
}

void append_utf8(std::string& to, std::uint32_t code) {
    const auto put = [&](std::uint32_t byte) { to += static_cast<char>(byte); };
    if (code < 0x80) {
        put(code);
    } else if (code < 0x800) {
        put(0xc0 | code >> 6);
        put(0x80 | (code & 0x3f));
    } else if (code < 0x10000) {
        put(0xe0 | code >> 12);
        put(0x80 | (code >> 6 & 0x3f));
        put(0x80 | (code & 0x3f));
    } else {
        put(0xf0 | code >> 18);
        put(0x80 | (code >> 12 & 0x3f));
        put(0x80 | (code >> 6 & 0x3f));
        put(0x80 | (code & 0x3f));
    }
}

/// UTF-16 behind its byte order mark as UTF-8. [RFC 2781]
std::string decode_utf16(const fs::path& path, std::string_view bytes) {
    const std::size_t low = bytes[0] == '\xFF' ? 0 : 1;
    const auto unit = [&](std::size_t at) {
        const auto byte = [&](std::size_t i) {
            return static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[i]));
        };
        return byte(at + low) | byte(at + 1 - low) << 8;
    };
    if (bytes.size() % 2 != 0) {
        throw Error(ErrorKind::Input,
                    fmt::format("{}: UTF-16 text of {} bytes: expected an even number", path.string(), bytes.size()));
    }
    std::string text;
    for (std::size_t at = 2; at < bytes.size(); at += 2) {
        std::uint32_t code = unit(at);
        if (code >= 0xd800 && code < 0xe000) {
            const std::uint32_t second = at + 2 < bytes.size() ? unit(at + 2) : 0;
            if (code >= 0xdc00 || second < 0xdc00 || second >= 0xe000) {
                throw Error(ErrorKind::Input,
                            fmt::format("{}: UTF-16 text: half a character at byte {}", path.string(), at));
            }
            code = 0x10000 + ((code - 0xd800) << 10) + (second - 0xdc00);
            at += 2;
        }
        append_utf8(text, code);
    }
    return text;
}

/// Throws MemoryError if so many times the size of the file do not fit the memory.
std::string read_whole(const fs::path& path, std::uint64_t copies) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (!fs::exists(status)) {
        fail_read(path, error && error != std::errc::no_such_file_or_directory ? error.message() : "no such file");
    }
    if (!fs::is_regular_file(status)) {
        fail_read(path, fs::is_directory(status) ? "it is a directory, a file is expected" : "it is not a file");
    }
    FileHandle file(std::fopen(path.c_str(), "rb"));
    if (!file) {
        fail_read(path, reason(errno));
    }
    // fstat of the open file: another one may have replaced it under this name.
    struct ::stat opened {};
    const std::size_t size =
        ::fstat(::fileno(file.get()), &opened) == 0 ? static_cast<std::size_t>(opened.st_size) : 0;
    require_memory(path.string(), copies * size, ErrorKind::Input);
    std::string bytes(size, '\0');
    bytes.resize(std::fread(bytes.data(), 1, bytes.size(), file.get()));
    if (std::ferror(file.get()) != 0) {
        fail_read(path, reason(errno));
    }
    return bytes;
}

}  // namespace

void fail_write(const fs::path& path, const std::string& why) {
    throw Error(ErrorKind::Runtime, fmt::format("{}: cannot be written: {}", path.string(), why));
}

std::string read_file(const fs::path& path) { return read_whole(path, 1); }

std::string read_text_file(const fs::path& path) {
    constexpr std::uint64_t kCopies = 3;  // what is read from a text takes twice its size at least
    std::string text = read_whole(path, kCopies);
    if (text.starts_with("\xEF\xBB\xBF")) {
        text.erase(0, 3);
    } else if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
        return decode_utf16(path, text);
    }
    return text;
}

void write_file_atomic(const fs::path& path, std::string_view bytes) {
    std::error_code ignored;
    fs::path target = path;
    if (fs::is_symlink(path, ignored)) {
        target = fs::weakly_canonical(path, ignored);
    }
    const fs::file_status status = fs::status(target, ignored);
    if (fs::is_directory(status)) {
        fail_write(path, "it is a directory");
    }
    if (fs::exists(status) && !fs::is_regular_file(status)) {
        if (const int failed = write_through(target, bytes)) {
            fail_write(path, reason(failed));
        }
        return;
    }
    clear_once(target.parent_path());
    TemporaryFile file(target);
    if (const int failed = file.replace_target(bytes)) {
        fail_write(path, reason(failed));
    }
}

std::string suffix_of(const std::filesystem::path& path) {
    std::string suffix = path.extension().string();
    std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return suffix;
}

bool stays_inside(const fs::path& folder, const fs::path& path) {
    if (path.is_absolute() || std::find(path.begin(), path.end(), "..") != path.end()) {
        return false;
    }
    std::error_code failed;
    const fs::path real_folder = fs::weakly_canonical(folder.empty() ? fs::path(".") : folder, failed);
    if (failed) {
        return false;
    }
    const fs::path real = fs::weakly_canonical(real_folder / path, failed);
    if (failed ||
        std::mismatch(real_folder.begin(), real_folder.end(), real.begin(), real.end()).first != real_folder.end()) {
        return false;
    }
    // A link that leads nowhere is left in the path: a file may come to be where it leads.
    for (fs::path part = real; part != real_folder; part = part.parent_path()) {
        if (fs::is_symlink(fs::symlink_status(part, failed))) {
            return false;
        }
    }
    return true;
}

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
