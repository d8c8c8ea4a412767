#include "core/io/files.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <mutex>
#include <set>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include "core/base/memory.h"
#include "core/io/temporary_file.h"

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

}  // namespace pl
